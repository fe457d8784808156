// SPDX-License-Identifier: Apache-2.0
// -write tree.html: what the command writes, and what a browser shows of it.

#include "BrowserPage.h"
#include "CommandRunner.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <map>
#include <sstream>

namespace {

using command_test::BrowserResult;
using command_test::CommandTest;
using command_test::openPage;
using command_test::readText;
using command_test::Result;
using command_test::writeText;

class CommandViewer : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
    }

    void write(const std::string& line) const
    {
        const Result result = run("-quiet " + line);
        ASSERT_EQ(result.exitCode, 0) << line << "\n" << result.err;
    }

    std::string pageOf(const std::string& line) const
    {
        write(line + " -write p.html");
        return readText(path("p.html"));
    }
};

TEST_F(CommandViewer, ShowsTheObjectThatTheTreeWasBuiltFrom)
{
    const std::string with = "id=\"surface-quads\"";
    const std::string built = pageOf("-read a.vol -spheretree tree=extended");
    EXPECT_NE(built.find(with), built.npos);
    write("-read a.vol -spheretree tree=extended -write t.vdb");
    const std::string alone = pageOf("-read t.vdb");
    EXPECT_EQ(alone.find(with), alone.npos);
    EXPECT_NE(alone.find("\"surface_missing\": \"the tree comes without its object\""), alone.npos);
    EXPECT_NE(pageOf("-read a.vol t.vdb").find(with), built.npos) << "the grid has its voxels";
    writeVol("b.vol", openvdb::Coord(3, 3, 3), std::string(27, '\1'));
    EXPECT_EQ(pageOf("-read b.vol t.vdb").find(with), built.npos) << "it is of another object";
    write("-read a.vol -spheretree -write q.html triangles=0");
    EXPECT_EQ(readText(path("q.html")).find(with), built.npos);
}

TEST_F(CommandViewer, GoesToStdoutWithTheSameBytesForAnyNumberOfThreads)
{
    const std::string line = "-read a.vol -spheretree spheres=6 cuts=1 -write ";
    const Result one = run("-quiet -threads 1 " + line + "stdout.html");
    const Result four = run("-quiet -threads 4 " + line + "stdout.html");
    ASSERT_EQ(one.exitCode, 0) << one.err;
    EXPECT_EQ(one.out.substr(0, 15), "<!doctype html>");
    EXPECT_EQ(one.out, four.out);
    write(line + "p.HTM");
    EXPECT_EQ(readText(path("p.HTM")), one.out);
}

TEST_F(CommandViewer, SaysWhatItCannotWrite)
{
    const auto before = files();
    const std::map<std::string, std::pair<int, std::string>> lines = {
        {"-read a.vol -write p.html", {3, "there is none: put -spheretree before"}},
        {"-read a.vol -spheretree keep=1 name=x -spheretree name=y vdb=1 -write p.html vdb=0,1",
            {3, "choose with vdb="}},
        {"-read a.vol -spheretree -write p.csv triangles=9", {2, "is for pages"}},
        {"-read a.vol -spheretree -write p.html triangles=-1", {2, "triangles=-1"}},
        {"-read a.vol -spheretree -write p.html eye=1,2,3", {2, "is for pictures"}}};
    for (const auto& [line, expected] : lines) {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, expected.first) << line << "\n" << result.err;
        EXPECT_NE(result.err.find(expected.second), std::string::npos) << result.err;
    }
    EXPECT_EQ(files(), before);
}

class CommandViewerInBrowser : public CommandViewer {
protected:
    void SetUp() override
    {
        CommandViewer::SetUp();
        if (command_test::browser().empty()) {
            GTEST_SKIP() << "there is no Chromium (Debian: apt-get install chromium)";
        }
    }

    /// Runs a script in p.html; it must neither fail nor make the browser complain.
    nlohmann::json drive(const std::string& script, const std::string& hash = {}) const
    {
        const BrowserResult result = openPage(path("p.html"), script, hash);
        EXPECT_EQ(result.console, "");
        EXPECT_TRUE(result.report.is_object()) << result.log;
        if (!result.report.is_object()) return nlohmann::json::object();
        EXPECT_FALSE(result.report.contains("failure")) << result.report.value("failure", "");
        return result.report;
    }

    /// The rows of a .csv by the number of the sphere, its columns by name.
    std::map<int, std::map<std::string, std::string>> table(const std::string& name) const
    {
        std::map<int, std::map<std::string, std::string>> rows;
        for (const auto& row : command_test::rowsOfCsv(readText(path(name)))) {
            rows[std::stoi(row.at("id"))] = row;
        }
        return rows;
    }
};

TEST_F(CommandViewerInBrowser, ShowsTheNumbersOfTheFile)
{
    writeGrids("ball.vdb", {sphereGrid("ball", 7.3f)});
    write("-read ball.vdb -spheretree spheres=40,8 quality=fast -write p.html t.csv -stats s.json");
    const auto rows = table("t.csv");
    const auto stats = nlohmann::json::parse(readText(path("s.json")));
    const auto report = drive(R"js(
        report.name = text('name');
        report.spheres = [];
        for (let id = 0; id < window.viewer.tree.nodes.size; ++id) {
            byId('find-id').value = id;
            byId('find').requestSubmit();
            report.spheres.push(sphere());
        }
        report.levels = [...document.querySelectorAll('#levels tbody tr')].map(
            (row) => [...row.cells].map((cell) => cell.textContent));
        report.curve = document.querySelector('#chart svg').getAttribute('aria-label');
        report.points = document.querySelectorAll('#chart .point').length;
    )js");
    EXPECT_EQ(report.at("name"), "spheretree");
    ASSERT_EQ(report.at("spheres").size(), rows.size());
    for (const auto& [id, row] : rows) {
        const auto& shown = report.at("spheres").at(size_t(id));
        EXPECT_EQ(shown.at("Number"), std::to_string(id));
        EXPECT_EQ(shown.at("Level"), row.at("level"));
        EXPECT_EQ(shown.at("Parent"), row.at("parent") == "-1" ? "none" : row.at("parent"));
        for (const char* name : {"x", "y", "z"}) {
            const std::string text = shown.at(std::string("Center ") + name);
            EXPECT_EQ(std::stod(text), std::stod(row.at(name))) << id;
        }
        const std::string radius = shown.at("Radius");
        EXPECT_EQ(std::stod(radius), std::stod(row.at("radius"))) << id;
    }
    const auto& levels = stats.at("levels");
    ASSERT_EQ(report.at("levels").size(), levels.size());
    for (size_t k = 0; k < levels.size(); ++k) {
        const auto& shown = report.at("levels").at(levels.size() - 1 - k);
        const std::string percent = shown.at(3);
        EXPECT_EQ(shown.at(0), std::to_string(k));
        EXPECT_EQ(shown.at(1), std::to_string(int(levels[k].at("spheres"))));
        const double exact = levels[k].at("hamming_percent");
        EXPECT_NEAR(std::stod(percent), exact, 1e-3 * exact);
    }
    EXPECT_EQ(report.at("points"), levels.size());
    const std::string curve = report.at("curve");
    EXPECT_NE(curve.find("with 1 sphere"), curve.npos) << curve;
}

TEST_F(CommandViewerInBrowser, ControlsChangeWhatIsShown)
{
    pageOf("-read a.vol -spheretree spheres=20,4,1 quality=fast cuts=1 name=block");
    const auto report = drive(R"js(
        const seen = (name) => { report[name] = text('shown'); };
        const { viewer } = window;
        const pictures = {};
        const draw = async (name) => { await wait(300); pictures[name] = picture(); };
        seen('first');
        await draw('first');
        set('level', 0);
        seen('coarse');
        await draw('coarse');
        document.querySelector('#levels tbody tr:nth-child(2) button').click();
        seen('table');
        document.querySelectorAll('#chart .point')[0].dispatchEvent(new MouseEvent('click'));
        seen('chart');
        set('count-exact', 7);
        seen('cut');
        report.level = byId('level').getAttribute('aria-valuetext');
        set('count', 0);
        seen('cutOfOne');
        press('PageDown');
        press('PageDown');
        set('level', 2);
        set('sphere-opacity', 1);
        await draw('opaque');
        set('color', 'radius');
        report.legend = text('legend');
        await draw('radius');
        set('clip-axis', 'x');
        set('clip-at', 0.4);
        report.clip = text('clip-text');
        await draw('clip');
        byId('clip-flip').click();
        await draw('flip');
        set('clip-axis', '');
        byId('theme').click();
        report.theme = document.documentElement.dataset.theme;
        await draw('theme');
        press('ArrowLeft');
        press('ArrowUp');
        press('ArrowUp', { shiftKey: true });
        press('+');
        await draw('turned');
        press('Home');
        await draw('home');
        const names = Object.keys(pictures);
        report.same = names.filter((name, i) => i > 0
            && difference(pictures[name], pictures[names[i - 1]]) < 0.002);
        report.home = difference(pictures.home, pictures.theme);
    )js",
        "theme=light&level=0");
    EXPECT_EQ(std::string(report.at("first")).substr(0, 8), "Level 0:");
    EXPECT_EQ(std::string(report.at("coarse")).substr(0, 18), "Level 2: 1 sphere,");
    EXPECT_EQ(std::string(report.at("table")).substr(0, 19), "Level 1: 4 spheres,");
    EXPECT_EQ(std::string(report.at("chart")).substr(0, 18), "Level 2: 1 sphere,");
    EXPECT_EQ(report.at("cut"), "The cut of 7 spheres");
    EXPECT_EQ(report.at("level"), "none: the cut of 7 spheres");
    EXPECT_EQ(report.at("cutOfOne"), "The cut of 1 sphere");
    EXPECT_EQ(std::string(report.at("clip")).substr(0, 4), "x = ");
    EXPECT_EQ(report.at("theme"), "dark");
    EXPECT_EQ(report.at("same"), nlohmann::json::array()) << "of these nobody sees a difference";
    EXPECT_EQ(report.at("home"), 0.0);
}

TEST_F(CommandViewerInBrowser, AClickSelectsTheSphereThatIsInFront)
{
    // Two in a row along z, the smaller one in front, and one aside.
    writeText(path("s.csv"), "x,y,z,radius\n0,0,0,2\n0,0,4,1\n6,0,0,1\n");
    pageOf("-read s.csv");
    const auto report = drive(R"js(
        document.querySelector('[data-view=z]').click();
        await wait(200);
        const at = (x, y) => { // of a point of the world as it is seen
            const { camera, frame } = window.viewer, view = camera.view();
            const apart = [x, y, 4].map((value, axis) => frame.along(axis, value) - view.eye[axis]);
            const ahead = -(apart[0] * view.z[0] + apart[1] * view.z[1] + apart[2] * view.z[2]);
            return [0.5 + apart[0] / ahead / view.halfHeight / view.aspect / 2,
                0.5 - apart[1] / ahead / view.halfHeight / 2];
        };
        click(...at(0, 0));
        report.front = sphere();
        report.said = text('announcement');
        click(...at(0, 1.3));
        report.behind = sphere();
        set('clip-axis', 'z');
        set('clip-at', 0.35); // cuts the first one open, and takes the one in front of it away
        click(...at(0, 0));
        report.cut = sphere();
        click(...at(3, 3));
        report.none = sphere();
        report.note = text('selection');
        press('Enter');
        press('Escape');
        report.nothing = text('announcement');
    )js");
    const auto& front = report.at("front");
    EXPECT_EQ(front.at("Center z"), "4");
    const std::string radius = front.at("Radius");
    EXPECT_NEAR(std::stod(radius), 1, 1e-6);
    const std::string said = report.at("said");
    EXPECT_NE(said.find("radius 1, center 0, 0, 4, no parent, 0 children."), said.npos) << said;
    EXPECT_EQ(report.at("behind").at("Center z"), "0");
    EXPECT_EQ(report.at("cut").at("Center z"), "0");
    EXPECT_EQ(report.at("none"), nlohmann::json::object());
    EXPECT_EQ(report.at("nothing"), "No sphere is selected.");
}

TEST_F(CommandViewerInBrowser, ParentsAndChildrenAreAClickAway)
{
    write("-read a.vol -spheretree tree=extended -write p.html t.csv");
    const auto rows = table("t.csv");
    const std::string parent = rows.rbegin()->second.at("parent");
    std::vector<std::string> children;
    for (const auto& [id, row] : rows) {
        if (row.at("parent") == parent) children.push_back(std::to_string(id));
    }
    const auto report = drive("const parent = " + parent + R"js(;
        byId('find-id').value = parent;
        byId('find').requestSubmit();
        const buttons = () => [...document.querySelectorAll('#sphere .many button')];
        report.children = buttons().map((button) => button.textContent);
        report.more = document.querySelector('#sphere .many').lastChild.textContent;
        buttons()[3].click();
        report.child = sphere();
        report.level = text('shown');
        document.querySelector('#sphere dd > button').click();
        report.parent = sphere();
        report.above = text('shown');
    )js");
    ASSERT_GT(children.size(), 24u);
    EXPECT_EQ(report.at("more"), "and " + std::to_string(children.size() - 24) + " more");
    children.resize(24);
    EXPECT_EQ(report.at("children"), children);
    EXPECT_EQ(report.at("child").at("Number"), children.at(3));
    EXPECT_EQ(report.at("child").at("Parent"), parent);
    EXPECT_EQ(report.at("parent").at("Number"), parent);
    EXPECT_EQ(std::string(report.at("level")).substr(0, 8), "Level 0:");
    EXPECT_EQ(std::string(report.at("above")).substr(0, 8), "Level 1:");
}

TEST_F(CommandViewerInBrowser, NamesAreTextWhateverTheyAre)
{
    const std::string evil = "</script><img src=x onerror=report.hacked=1>&lt;b>";
    ASSERT_EQ(runWords({"-quiet", "-read", "a.vol", "-spheretree", "tree=extended", "name=" + evil,
                           "-write", "p.html"})
                  .exitCode,
        0);
    const auto report = drive(R"js(
        report.name = text('name');
        report.title = document.title;
        report.images = document.images.length;
    )js");
    EXPECT_EQ(report.at("name"), evil);
    EXPECT_EQ(std::string(report.at("title")).substr(0, evil.size()), evil);
    EXPECT_EQ(report.at("images"), 0);
}

TEST_F(CommandViewerInBrowser, EveryControlHasANameAndCanBeReached)
{
    pageOf("-read a.vol -spheretree spheres=20,4 quality=fast cuts=1");
    const auto report = drive(R"js(
        const controls = [...document.querySelectorAll('input, select, button, canvas')];
        const nameOf = (each) => each.getAttribute('aria-label') || each.labels?.[0]?.textContent.trim()
            || each.textContent.trim();
        report.nameless = controls.filter((each) => !nameOf(each)).map((each) => each.outerHTML);
        report.unreachable = controls.filter((each) => each.tabIndex < 0).map((each) => each.outerHTML);
        report.wide = document.documentElement.scrollWidth > innerWidth;
        report.language = document.documentElement.lang;
        // Contrast of text with what it stands on, by the rules of WCAG.
        const light = ([r, g, b]) => [0.2126 * r, 0.7152 * g, 0.0722 * b].reduce((a, v) => a + v);
        const linear = (v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
        const colorOf = (name) => {
            const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
            return light([1, 3, 5].map((at) => linear(parseInt(hex.slice(at, at + 2), 16) / 255)));
        };
        const contrast = (a, b) => {
            const [low, high] = [colorOf(a), colorOf(b)].sort((x, y) => x - y);
            return (high + 0.05) / (low + 0.05);
        };
        report.contrasts = [];
        for (const theme of ['light', 'dark']) {
            document.documentElement.dataset.theme = theme;
            report.contrasts.push([theme, Math.min(contrast('--text', '--panel'),
                contrast('--muted', '--panel'), contrast('--accent', '--panel'),
                contrast('--accent-text', '--accent')),
                Math.min(contrast('--control', '--panel'), contrast('--mark', '--panel'))]);
        }
    )js");
    EXPECT_EQ(report.at("nameless"), nlohmann::json::array());
    EXPECT_EQ(report.at("unreachable"), nlohmann::json::array());
    EXPECT_EQ(report.at("wide"), false) << "at the width of a telephone";
    EXPECT_EQ(report.at("language"), "en");
    for (const auto& [theme, text, lines] :
        report.at("contrasts").get<std::vector<std::tuple<std::string, double, double>>>()) {
        EXPECT_GE(text, 4.5) << theme;
        EXPECT_GE(lines, 3.0) << theme;
    }
}

TEST_F(CommandViewerInBrowser, EachPixelOfACutShowsTheBallThatItIsDeepestIn)
{
    writeGrids("ball.vdb", {sphereGrid("ball", 11.3f)});
    pageOf("-read ball.vdb -spheretree tree=extended");
    // Tiles leave balls out; here each is tried.
    const auto report = drive(R"js(
        const { viewer } = window, [width, height] = [120, 90], all = width * height;
        const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        const along = (a, t, b) => [0, 1, 2].map((i) => a[i] + t * b[i]);
        const balls = Array.from({ length: viewer.shapes.length / 4 },
            (_, i) => ({ center: viewer.shapes.subarray(4 * i, 4 * i + 3), radius: viewer.shapes[4 * i + 3] }));
        // In front are balls that hold the point of the plane, the one that it is deepest in first.
        const shownBy = (eye, ray, plane) => {
            const speed = dot(plane.normal, ray), height = dot(plane.normal, eye) + plane.offset;
            const cut = -height / speed;
            let [found, deepest, nearest] = [-1, 0, Infinity];
            balls.forEach(({ center, radius }, i) => {
                const from = along(eye, -1, center), middle = -dot(from, ray);
                const half = Math.sqrt(radius * radius - dot(from, from) + middle * middle);
                const point = along(from, cut, ray);
                const depth = speed > 0 ? radius - dot(point, point) / radius : 0;
                const isKept = (speed > 0) === (middle - half > cut);
                if (depth > deepest) [found, deepest] = [i, depth];
                else if (deepest === 0 && half >= 0 && isKept && middle - half < nearest)
                    [found, nearest] = [i, middle - half];
            });
            return found;
        };
        const tiles = new viewer.renderer.tiles.constructor();
        viewer.camera.aspect = width / height;
        viewer.camera.fit();
        report.wrong = [];
        for (const clip of ['z,0.5', 'z,0.3', 'x,0.6', 'y,0.45,flip', 'y,0.8']) {
            const [axis, at, flip] = clip.split(',');
            viewer.show({ clip: { axis, at: Number(at), flip: Boolean(flip) } });
            const view = viewer.camera.view(), look = viewer.currentLook();
            tiles.find(viewer.shapes, look, view, width, height);
            let wrong = 0, shown = 0;
            for (let i = 0; i < all; ++i) {
                const right = (2 * ((i % width) + 0.5)) / width - 1;
                const up = (2 * (Math.floor(i / width) + 0.5)) / height - 1;
                const aside = along(along([0, 0, 0], right * view.halfHeight * view.aspect, view.x),
                    up * view.halfHeight, view.y);
                const way = along(aside, -1, view.z);
                const found = shownBy(view.eye, along([0, 0, 0], 1 / Math.hypot(...way), way), look.clip);
                shown += found >= 0;
                wrong += tiles.seen[i] !== found + 1;
            }
            report.wrong.push([clip, wrong / shown, shown / all]);
        }
    )js");
    for (const auto& [clip, wrong, shown] :
        report.at("wrong").get<std::vector<std::tuple<std::string, double, double>>>()) {
        EXPECT_LE(wrong, 0.005) << clip << ": more than are on outlines, or as deep in two";
        EXPECT_GE(shown, 0.1) << clip;
    }
}

/// Trees of every kind; the pictures of both ways to draw them, which have no code in common but the
/// formulas of a ball, must agree.
class CommandViewerOfKind
    : public CommandViewerInBrowser,
      public testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(CommandViewerOfKind, IsDrawnAlikeByTrianglesAndByPixels)
{
    writeVol("f.vol", openvdb::Coord(9, 7, 1), std::string(63, '\1'));
    writeText(path("s.csv"), "x,y,z,radius\n0,0,0,2\n1,2,3,1.5\n");
    pageOf(GetParam().second);
    const auto report = drive(R"js(
        const { viewer } = window, own = viewer.renderer;
        const other = new own.constructor(document.createElement('canvas'), 'triangles');
        report.byTiles = own.byTiles;
        report.worst = 0;
        report.drawn = 1;
        set('sphere-opacity', 1);
        set('surface-opacity', 0);
        for (const clip of ['', 'y']) {
            set('clip-axis', clip);
            await wait(100);
            const byTiles = picture();
            other.setSpheres(viewer.shapes);
            other.setColors(viewer.colors);
            viewer.renderer = other;
            const byTriangles = picture();
            set('sphere-opacity', 0);
            report.drawn = Math.min(report.drawn, difference(byTriangles, picture()));
            viewer.renderer = own;
            set('sphere-opacity', 1);
            report.worst = Math.max(report.worst, difference(byTiles, byTriangles));
        }
    )js",
        "draw=tiles");
    EXPECT_EQ(report.at("byTiles"), true);
    EXPECT_LE(report.at("worst"), 0.03);
    EXPECT_GE(report.at("drawn"), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Kinds, CommandViewerOfKind,
    testing::Values(std::pair("Tight", "-read a.vol -spheretree spheres=20,4 quality=fast"),
        std::pair("Inner", "-read a.vol -spheretree side=inner spheres=12,4"),
        std::pair("Fit", "-read a.vol -spheretree side=fit spheres=12,4"),
        std::pair("Reversible", "-read a.vol -spheretree tree=reversible errors=0 topology=0"),
        std::pair("Extended", "-read a.vol -spheretree tree=extended"),
        std::pair("L1", "-read a.vol -spheretree tree=extended dist=l1"),
        std::pair("Linf", "-read a.vol -spheretree tree=reversible dist=linf"),
        std::pair("Chamfer", "-read a.vol -spheretree tree=reversible dist=chamfer:3,4,5"),
        std::pair("Flat", "-read f.vol -spheretree dim=2 spheres=9,3 quality=fast"),
        std::pair("Given", "-read s.csv"),
        std::pair("OneLevel", "-read a.vol -spheretree tree=extended -level 1")),
    [](const auto& info) { return std::string(info.param.first); });

} // namespace
