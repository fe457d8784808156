// SPDX-License-Identifier: Apache-2.0
// Pages of -write tree.html as people use them: by the mouse, with the colours of their system, without WebGL2.

#include "BrowserDriver.h"
#include "BrowserPage.h"
#include "CommandRunner.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace {

using command_test::BrowserDriver;
using command_test::CommandTest;
using command_test::mentions;
using command_test::readText;
using command_test::Result;
using command_test::Screenshot;

/// Where an element is in the window.
struct Box {
    double left, top, width, height;

    double x(double share) const { return left + share * width; }
    double y(double share) const { return top + share * height; }
};

class CommandViewerDriven : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        if (command_test::browser().empty()) {
            GTEST_SKIP() << "there is no Chromium (Debian: apt-get install chromium)";
        }
        writeBlock("a.vol");
        const Result result = run("-quiet -read a.vol -spheretree spheres=20,4,1 quality=fast "
                                  "cuts=1 -write p.html t.csv");
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }

    static Box boxOf(BrowserDriver& browser, const std::string& selector)
    {
        const auto box = browser.value("(() => { const { left, top, width, height } = "
                                       "document.querySelector('"
            + selector + "').getBoundingClientRect(); return [left, top, width, height]; })()");
        return {box.at(0), box.at(1), box.at(2), box.at(3)};
    }

    static std::string textOf(BrowserDriver& browser, const std::string& selector)
    {
        return browser.value("document.querySelector('" + selector + "').textContent");
    }

    /// Chooses as a user does.
    static void set(BrowserDriver& browser, const std::string& id, const std::string& text)
    {
        browser.value("(() => { const control = document.getElementById('" + id
            + "'); control.value = '" + text
            + "'; for (const name of ['input', 'change']) control.dispatchEvent(new Event(name)); "
              "return new Promise((done) => setTimeout(done, 300)); })()");
    }

    /// The terms of the selected sphere, and the numbers of its children.
    static nlohmann::json selected(BrowserDriver& browser)
    {
        return browser.value("Object.fromEntries([...document.querySelectorAll('#sphere dt')].map("
                             "(term) => [term.textContent, term.nextSibling.querySelector('.many') "
                             "? [...term.nextSibling.querySelectorAll('button')].map((button) => "
                             "button.textContent) : term.nextSibling.textContent]))");
    }

    /// Rows of t.csv by the number of the sphere, its columns by name.
    std::map<std::string, std::map<std::string, std::string>> rows() const
    {
        std::map<std::string, std::map<std::string, std::string>> all;
        for (const auto& row : command_test::rowsOfCsv(readText(path("t.csv")))) {
            all[row.at("id")] = row;
        }
        return all;
    }
};

/// The share of pixels of the view that differ clearly.
double difference(const Screenshot& a, const Screenshot& b)
{
    if (a.pixels.empty() || a.pixels.size() != b.pixels.size()) return -1;
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            if (std::abs(a.pixels[i][c] - b.pixels[i][c]) <= 24) continue;
            ++count;
            break;
        }
    }
    return double(count) / double(a.pixels.size());
}

/// @return in steps of 20 degrees, the hues that at least one in a hundred clearly coloured pixels of a box has.
std::set<int> huesOf(const Screenshot& picture, const Box& box)
{
    std::map<int, int> counts;
    int all = 0;
    for (int y = int(box.top) + 1; y < int(box.y(1)) - 1; ++y) {
        for (int x = int(box.left) + 1; x < int(box.x(1)) - 1; ++x) {
            const auto& pixel = picture.pixels.at(size_t(y) * size_t(picture.width) + size_t(x));
            const auto [low, high] = std::minmax({pixel[0], pixel[1], pixel[2]});
            if (high - low < 60) continue; // the background and what is nearly grey
            const double a = pixel[0] - 0.5 * (pixel[1] + pixel[2]);
            const double b = std::sqrt(0.75) * (pixel[1] - pixel[2]);
            const double degrees = std::atan2(b, a) * 180 / 3.141592653589793 + 360;
            ++counts[int(std::lround(degrees / 20)) % 18];
            ++all;
        }
    }
    std::set<int> hues;
    for (const auto& [hue, count] : counts) {
        if (100 * count > all) hues.insert(hue);
    }
    return hues;
}

TEST_F(CommandViewerDriven, ADragTurnsAndTheWheelZooms)
{
    BrowserDriver browser(path("p.html"));
    const Box view = boxOf(browser, "#canvas");
    const auto camera = [&] {
        return browser.value("(({ yaw, pitch, size, target }) => ({ yaw, pitch, size, target }))"
                             "(window.viewer.camera)");
    };
    const auto home = camera();
    const Screenshot atHome = browser.screenshot("home");

    browser.drag(view.x(0.5), view.y(0.5), view.x(0.7), view.y(0.6));
    const auto turned = camera();
    // To the right: what is in front goes with the mouse, so the eye goes to the left; down: it goes up.
    EXPECT_LT(turned.at("yaw"), home.at("yaw"));
    EXPECT_GT(turned.at("pitch"), home.at("pitch"));
    EXPECT_EQ(turned.at("size"), home.at("size"));
    EXPECT_EQ(turned.at("target"), home.at("target"));
    EXPECT_EQ(selected(browser), nlohmann::json::object()) << "a drag is no click";
    const Screenshot afterTurn = browser.screenshot("turned");
    EXPECT_GT(difference(atHome, afterTurn), 0.01);

    browser.wheel(view.x(0.5), view.y(0.5), -240);
    const auto near = camera();
    EXPECT_LT(double(near.at("size")), 0.9 * double(turned.at("size")));
    EXPECT_EQ(near.at("yaw"), turned.at("yaw"));
    EXPECT_GT(difference(afterTurn, browser.screenshot("near")), 0.01);
    browser.wheel(view.x(0.5), view.y(0.5), 480);
    EXPECT_GT(double(camera().at("size")), double(turned.at("size")));
    EXPECT_EQ(browser.value("scrollY + document.getElementById('panel').scrollTop"), 0)
        << "the wheel belongs to the view";
    EXPECT_EQ(browser.console(), "");
}

TEST_F(CommandViewerDriven, AClickShowsASphereWithItsParentAndItsChildren)
{
    BrowserDriver browser(path("p.html"), {{}, "light", "level=1&opacity=1&surface=0"});
    const Box view = boxOf(browser, "#canvas");
    browser.click(view.x(0.5), view.y(0.5));
    auto shown = selected(browser);
    browser.screenshot("selected");
    const auto table = rows();
    const std::string id = shown.value("Number", "none");
    ASSERT_EQ(table.count(id), 1u) << shown.dump();
    const auto& row = table.at(id);
    EXPECT_EQ(shown.at("Level"), "1");
    for (const auto& [term, column] : {std::pair("Center x", "x"), std::pair("Center y", "y"),
             std::pair("Center z", "z"), std::pair("Radius", "radius")}) {
        const std::string text = shown.at(term);
        EXPECT_EQ(std::stod(text), std::stod(row.at(column))) << term;
    }
    EXPECT_EQ(shown.at("Parent"), row.at("parent"));
    std::vector<std::string> children;
    for (const auto& [child, its] : table) {
        if (its.at("parent") == id) children.push_back(child);
    }
    ASSERT_GT(children.size(), 1u);
    std::sort(children.begin(), children.end(),
        [](const auto& a, const auto& b) { return std::stoi(a) < std::stoi(b); });
    EXPECT_EQ(shown.at(std::to_string(children.size()) + " children"), children);

    // Its parent is a click away, and beside all spheres is none.
    browser.value("document.querySelector('#sphere').scrollIntoView()");
    const Box parent = boxOf(browser, "#sphere dd > button");
    browser.click(parent.x(0.5), parent.y(0.5));
    shown = selected(browser);
    EXPECT_EQ(shown.at("Number"), row.at("parent"));
    EXPECT_EQ(shown.at("Parent"), "none");
    browser.click(view.x(0.02), view.y(0.98));
    EXPECT_EQ(selected(browser), nlohmann::json::object());
    EXPECT_EQ(browser.console(), "");
}

TEST_F(CommandViewerDriven, WithoutWebGl2ASentenceSaysWhatIsMissing)
{
    BrowserDriver browser(path("p.html"), {{"--disable-3d-apis"}, "light", ""});
    ASSERT_EQ(
        browser.value("document.createElement('canvas').getContext('webgl2') === null"), true);
    const std::string said = textOf(browser, "#failure");
    EXPECT_TRUE(mentions(said, "cannot be drawn: this browser has no WebGL2")) << said;
    const Box notice = boxOf(browser, "#failure");
    EXPECT_GT(notice.width * notice.height, 1000) << "it is to be seen";
    // The numbers are there, and can be walked through.
    EXPECT_EQ(textOf(browser, "#shown").substr(0, 19), "Level 0: 12 spheres");
    set(browser, "level", "0");
    EXPECT_EQ(textOf(browser, "#shown").substr(0, 17), "Level 2: 1 sphere");
    set(browser, "color", "level");
    const Box view = boxOf(browser, "#canvas");
    browser.drag(view.x(0.5), view.y(0.2), view.x(0.7), view.y(0.3));
    browser.wheel(view.x(0.5), view.y(0.2), -240);
    browser.screenshot("without-webgl2");
    EXPECT_EQ(browser.console(), "");
}

TEST_F(CommandViewerDriven, ByLevelAllSpheresOfALevelHaveOneColour)
{
    BrowserDriver browser(path("p.html"), {{}, "light", "opacity=1&surface=0"});
    const Box view = boxOf(browser, "#canvas");
    EXPECT_GT(huesOf(browser.screenshot("by-parent"), view).size(), 2u) << "by parent";
    set(browser, "color", "level");
    EXPECT_EQ(boxOf(browser, "#legend .scale").height, 10) << "a scale tells which is which";
    EXPECT_EQ(textOf(browser, "#legend .ends"), "level 0level 2");
    std::set<int> seen;
    for (const char* place : {"2", "1", "0"}) { // on the slider, where the coarsest is on the left
        set(browser, "level", place);
        const std::set<int> hues =
            huesOf(browser.screenshot(std::string("by-level-") + place), view);
        // One hue may lie on the border of two steps.
        ASSERT_FALSE(hues.empty());
        EXPECT_LE(*hues.rbegin() - *hues.begin(), 1) << "at " << place;
        EXPECT_TRUE(seen.insert(*hues.begin()).second) << "another level has this colour";
    }
    EXPECT_EQ(browser.console(), "");
}

TEST_F(CommandViewerDriven, TheErrorCurveMarksTheLevelThatIsShown)
{
    BrowserDriver browser(path("p.html"), {{}, "light", ""});
    browser.value("document.querySelector('#chart').scrollIntoView()");
    EXPECT_EQ(browser.value("scrollY"), 0) << "only the panel scrolls: the view stays where it is";
    const auto marks = [&] {
        return browser.value(
            "[...document.querySelectorAll('#chart .point')].map((point) => [point.querySelector("
            "'title').textContent.slice(0, 7), point.classList.contains('current'), "
            "getComputedStyle(point).fill])");
    };
    const auto require = [&](const std::string& level) {
        std::set<std::string> others;
        std::string current;
        for (const auto& mark : marks()) {
            EXPECT_EQ(mark.at(1), mark.at(0) == level) << mark.dump();
            if (mark.at(1)) current = mark.at(2);
            else others.insert(std::string(mark.at(2)));
        }
        EXPECT_FALSE(current.empty()) << level;
        EXPECT_EQ(others.count(current), 0u) << "it has a colour of its own";
        // The line is where the point is.
        EXPECT_EQ(browser.value("document.querySelector('#chart .current').getAttribute('cx') === "
                                "document.querySelector('#chart .now').getAttribute('x1')"),
            true);
    };
    require("Level 0");
    for (int i = 0; i < 3; ++i) { // the coarsest first
        const Box point =
            boxOf(browser, "#chart .point:nth-of-type(" + std::to_string(i + 1) + ")");
        browser.click(point.x(0.5), point.y(0.5));
        EXPECT_EQ(textOf(browser, "#shown").substr(0, 7), "Level " + std::to_string(2 - i));
        require("Level " + std::to_string(2 - i));
        browser.screenshot("curve-" + std::to_string(2 - i));
    }
    set(browser, "count-exact", "7");
    for (const auto& mark : marks()) EXPECT_EQ(mark.at(1), false) << "a cut is no level";
    EXPECT_EQ(browser.console(), "");
}

TEST_F(CommandViewerDriven, TheBackgroundIsThatOfTheSystem)
{
    std::map<std::string, int> ofView, ofPanel;
    for (const std::string scheme : {"light", "dark"}) {
        BrowserDriver browser(path("p.html"), {{}, scheme, ""});
        const Screenshot picture = browser.screenshot(scheme);
        ASSERT_FALSE(picture.pixels.empty());
        const Box view = boxOf(browser, "#canvas"), panel = boxOf(browser, "#panel");
        const auto lightAt = [&](double x, double y) {
            const auto& pixel = picture.at(x / picture.width, y / picture.height);
            return pixel[0] + pixel[1] + pixel[2];
        };
        ofView[scheme] = lightAt(view.x(0.01), view.y(0.5));
        ofPanel[scheme] = lightAt(panel.x(0.01), panel.y(0.5));
        EXPECT_EQ(textOf(browser, "#theme"), "Dark");
        EXPECT_EQ(browser.value("document.getElementById('theme').ariaPressed"),
            scheme == "dark" ? "true" : "false");
        EXPECT_EQ(browser.console(), "");
    }
    EXPECT_GT(ofView.at("light"), 600);
    EXPECT_LT(ofView.at("dark"), 200);
    EXPECT_GT(ofPanel.at("light"), 700);
    EXPECT_LT(ofPanel.at("dark"), 120);
}

TEST_F(CommandViewerDriven, TheSystemIsFollowedUntilSomebodyChooses)
{
    const auto isDark = [](BrowserDriver& browser) {
        browser.value("new Promise((done) => setTimeout(done, 500))"); // until it is drawn anew
        const int light = browser.screenshot("followed").at(0.005, 0.5)[0];
        const bool isPressed =
            browser.value("document.getElementById('theme').ariaPressed") == "true";
        EXPECT_EQ(light < 70, isPressed);
        return isPressed;
    };
    {
        BrowserDriver browser(path("p.html"), {{}, "light", ""});
        EXPECT_FALSE(isDark(browser));
        browser.setColorScheme("dark");
        EXPECT_TRUE(isDark(browser));
        browser.setColorScheme("light");
        EXPECT_FALSE(isDark(browser));
        const Box button = boxOf(browser, "#theme");
        browser.click(button.x(0.5), button.y(0.5));
        EXPECT_TRUE(isDark(browser));
        browser.setColorScheme("dark");
        browser.setColorScheme("light");
        EXPECT_TRUE(isDark(browser)) << "it was chosen";
        EXPECT_EQ(browser.console(), "");
    }
    BrowserDriver typed(path("p.html"), {{}, "light", "theme=dark"});
    typed.setColorScheme("dark");
    typed.setColorScheme("light");
    EXPECT_TRUE(isDark(typed)) << "the address says so";
    EXPECT_EQ(typed.console(), "");
}

} // namespace
