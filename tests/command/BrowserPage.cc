// SPDX-License-Identifier: Apache-2.0
#include "BrowserPage.h"

#include "CommandRunner.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace command_test {

namespace {

/// Runs the script when a frame has been drawn, and puts what it reports into the page.
std::string wrapped(const std::string& script)
{
    return R"html(
<script type="module">
const report = {};
const byId = (id) => document.getElementById(id);
const text = (id) => byId(id).textContent.replace(/\s+/g, ' ').trim();
const wait = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
// Moves a slider, or chooses, as a user does.
const set = (id, value) => {
    byId(id).value = value;
    for (const name of ['input', 'change']) byId(id).dispatchEvent(new Event(name, { bubbles: true }));
};
const press = (key, options = {}) => byId('canvas').dispatchEvent(
    new KeyboardEvent('keydown', { key, cancelable: true, ...options }));
// Presses and lets go at a point of the view, from 0 to 1 from its left and its top.
const click = (right, down) => {
    const box = byId('canvas').getBoundingClientRect();
    const at = { clientX: box.left + right * box.width, clientY: box.top + down * box.height,
        button: 0, pointerId: 1, bubbles: true };
    for (const name of ['pointerdown', 'pointerup']) byId('canvas').dispatchEvent(new PointerEvent(name, at));
};
// The numbers of the selected sphere by their names.
const sphere = () => Object.fromEntries(
    [...document.querySelectorAll('#sphere dt')].map((term) => [term.textContent, term.nextSibling.textContent]));
// The picture as bytes, drawn anew, small.
const picture = () => {
    const { viewer } = window, { renderer } = viewer, { gl, canvas } = renderer;
    canvas.width = 200;
    canvas.height = 150;
    renderer.draw(viewer.camera.view(), viewer.currentLook());
    const bytes = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return bytes;
};
// The share of pixels in which two pictures differ clearly.
const difference = (a, b) => {
    let count = 0;
    for (let i = 0; i < a.length; i += 4) {
        count += [0, 1, 2].some((c) => Math.abs(a[i + c] - b[i + c]) > 24);
    }
    return count / (a.length / 4);
};
try {
    await wait(100);
)html" + script
        + R"html(
} catch (error) {
    report.failure = String(error.stack ?? error);
}
const result = document.createElement('pre');
result.id = 'result';
result.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(report))));
document.body.append(result);
</script>
)html";
}

/// What the browser's console has, but for complaints of reading pixels: only these scripts do.
std::string consoleOf(const std::string& text)
{
    std::istringstream lines(text);
    std::string found, line;
    while (std::getline(lines, line)) {
        const bool isOwn = line.find("GPU stall due to ReadPixels") != line.npos;
        if (line.find(":CONSOLE") != line.npos && !isOwn) found += line + "\n";
    }
    return found;
}

} // namespace

std::string fromBase64(const std::string& text)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        if (digits.find(c) == digits.npos) break;
        bits = (bits << 6 | unsigned(digits.find(c))) & 0xffff;
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes += char(bits >> count & 255);
    }
    return bytes;
}

std::string browser()
{
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
        if (std::system((std::string("command -v ") + name + " > /dev/null 2>&1").c_str()) == 0) {
            return name;
        }
    }
    return {};
}

BrowserResult openPage(
    const std::filesystem::path& page, const std::string& script, const std::string& hash)
{
    std::filesystem::path driven = page;
    driven.replace_extension(".driven.html");
    writeText(driven, readText(page) + wrapped(script));
    const std::filesystem::path profile = page.parent_path() / "browser";
    const Result result = Running(
        {"/usr/bin/env", browser(), "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
            "--no-first-run", "--user-data-dir=" + profile.string(), "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader", "--enable-logging=stderr", "--window-size=480,360",
            "--virtual-time-budget=20000", "--dump-dom", "file://" + driven.string() + "#" + hash},
        page.parent_path())
                              .wait();
    std::filesystem::remove_all(profile);
    BrowserResult found;
    found.log = result.err;
    found.console = consoleOf(result.err);
    const std::string start = "<pre id=\"result\">";
    const size_t at = result.out.find(start);
    if (at == result.out.npos) return found;
    found.report = nlohmann::json::parse(fromBase64(result.out.substr(at + start.size())));
    return found;
}

} // namespace command_test
