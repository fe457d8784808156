// SPDX-License-Identifier: Apache-2.0
#include "BrowserDriver.h"

#include "BrowserPage.h"

#include <cstdlib>

#include <fcntl.h>
#include <png.h>
#include <poll.h>
#include <unistd.h>

namespace command_test {

namespace {

constexpr int kCommands = 3, kAnswers = 4; ///< where Chromium looks for the ends of its pipes
constexpr int kPatience = 60000;           ///< milliseconds for an answer

Screenshot decoded(const std::string& png)
{
    Screenshot picture;
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0) return picture;
    image.format = PNG_FORMAT_RGB;
    std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) == 0) return picture;
    picture.width = int(image.width);
    picture.height = int(image.height);
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
        picture.pixels.push_back({bytes[i], bytes[i + 1], bytes[i + 2]});
    }
    return picture;
}

} // namespace

const std::array<int, 3>& Screenshot::at(double right, double down) const
{
    const auto column = std::size_t(right * width), row = std::size_t(down * height);
    return pixels.at(row * std::size_t(width) + column);
}

BrowserDriver::Pipe BrowserDriver::makePipe()
{
    int ends[2] = {-1, -1};
    if (pipe(ends) != 0) return {};
    Pipe moved; // away from the numbers that the browser takes
    moved.read = fcntl(ends[0], F_DUPFD_CLOEXEC, 16);
    moved.write = fcntl(ends[1], F_DUPFD_CLOEXEC, 16);
    for (const int end : ends) close(end);
    return moved;
}

BrowserDriver::BrowserDriver(const std::filesystem::path& page, const DrivenBrowser& options)
    : mProfile(page.parent_path() / "browser"), mTo(makePipe()), mFrom(makePipe())
{
    std::vector<std::string> line = {browser(), "--headless=new", "--no-sandbox",
        "--disable-dev-shm-usage", "--no-first-run", "--user-data-dir=" + mProfile.string(),
        "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
        "--window-size=1000,700", "--remote-debugging-pipe"};
    line.insert(line.end(), options.flags.begin(), options.flags.end());
    line.emplace_back("about:blank");
    mBrowser.emplace(line, page.parent_path(), "/dev/null", [this] {
        dup2(mTo.read, kCommands);
        dup2(mFrom.write, kAnswers);
    });
    // Without these ends, the end of the browser is the end of what it says.
    close(mTo.read);
    close(mFrom.write);

    const auto targets = call("Target.getTargets").value("targetInfos", nlohmann::json::array());
    for (const auto& target : targets) {
        if (target.at("type") != "page") continue;
        mSession =
            call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                .value("sessionId", "");
    }
    for (const char* domain : {"Page.enable", "Runtime.enable", "Log.enable"}) call(domain);
    if (!options.colorScheme.empty()) setColorScheme(options.colorScheme);
    call("Page.navigate", {{"url", "file://" + page.string() + "#" + options.hash}});
    while (!mIsLoaded && !mHasFailed) takeEvent(nextMessage());
    // Its first frame may be drawn later.
    value("new Promise((done) => setTimeout(done, 300))");
}

void BrowserDriver::setColorScheme(const std::string& scheme)
{
    call("Emulation.setEmulatedMedia",
        {{"features", {{{"name", "prefers-color-scheme"}, {"value", scheme}}}}});
}

BrowserDriver::~BrowserDriver()
{
    if (!mHasFailed) {
        mSession.clear();
        call("Browser.close");
        mBrowser->wait();
    }
    mBrowser.reset();
    close(mTo.write);
    close(mFrom.read);
    std::error_code ignored;
    std::filesystem::remove_all(mProfile, ignored);
}

nlohmann::json BrowserDriver::nextMessage()
{
    for (;;) {
        const std::size_t end = mReceived.find('\0'); // each message has one behind it
        if (end != mReceived.npos) {
            const auto message = nlohmann::json::parse(mReceived.substr(0, end));
            mReceived.erase(0, end + 1);
            return message;
        }
        pollfd ready = {mFrom.read, POLLIN, 0};
        std::array<char, 1 << 16> bytes;
        const bool isThere = poll(&ready, 1, kPatience) == 1;
        const ssize_t count = isThere ? read(mFrom.read, bytes.data(), bytes.size()) : 0;
        if (count > 0) {
            mReceived.append(bytes.data(), std::size_t(count));
            continue;
        }
        ADD_FAILURE() << "the browser says nothing";
        mHasFailed = true;
        return {};
    }
}

nlohmann::json BrowserDriver::call(const std::string& method, const nlohmann::json& parameters)
{
    if (mHasFailed) return nlohmann::json::object();
    nlohmann::json message = {{"id", ++mCalls}, {"method", method}, {"params", parameters}};
    if (!mSession.empty()) message["sessionId"] = mSession;
    const std::string text = message.dump();
    // With the null character at its end.
    if (write(mTo.write, text.c_str(), text.size() + 1) != ssize_t(text.size() + 1)) {
        ADD_FAILURE() << "the browser does not listen";
        mHasFailed = true;
    }
    while (!mHasFailed) {
        const nlohmann::json answer = nextMessage();
        if (!answer.contains("id")) {
            takeEvent(answer);
            continue;
        }
        if (answer.at("id") != mCalls) continue;
        if (answer.contains("result")) return answer.at("result");
        ADD_FAILURE() << method << ": " << answer.dump();
        break;
    }
    return nlohmann::json::object();
}

void BrowserDriver::takeEvent(const nlohmann::json& message)
{
    const std::string method = message.value("method", "");
    if (method == "Page.loadEventFired") mIsLoaded = true;
    const bool isComplaint = method == "Log.entryAdded" || method == "Runtime.consoleAPICalled"
        || method == "Runtime.exceptionThrown";
    if (isComplaint) mConsole += message.at("params").dump() + "\n";
}

nlohmann::json BrowserDriver::value(const std::string& expression)
{
    const nlohmann::json answer = call("Runtime.evaluate",
        {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    EXPECT_FALSE(answer.contains("exceptionDetails")) << answer.dump();
    return answer.value("result", nlohmann::json::object()).value("value", nlohmann::json());
}

void BrowserDriver::mouse(const std::string& type, double x, double y, const nlohmann::json& more)
{
    nlohmann::json event = {{"type", type}, {"x", x}, {"y", y}};
    event.update(more);
    call("Input.dispatchMouseEvent", event);
}

void BrowserDriver::moveTo(double x, double y) { mouse("mouseMoved", x, y, {{"button", "none"}}); }

void BrowserDriver::click(double x, double y) { drag(x, y, x, y); }

void BrowserDriver::drag(double x, double y, double toX, double toY)
{
    constexpr int kSteps = 5;
    const nlohmann::json pressed = {{"button", "left"}, {"buttons", 1}, {"clickCount", 1}};
    moveTo(x, y);
    mouse("mousePressed", x, y, pressed);
    for (int step = 1; step <= kSteps; ++step) {
        const double share = double(step) / kSteps;
        mouse("mouseMoved", x + share * (toX - x), y + share * (toY - y), pressed);
    }
    mouse("mouseReleased", toX, toY, {{"button", "left"}, {"clickCount", 1}});
}

void BrowserDriver::wheel(double x, double y, double down)
{
    mouse("mouseWheel", x, y, {{"deltaX", 0}, {"deltaY", down}});
    value(
        "new Promise((done) => setTimeout(done, 100))"); // the answer may come before the page has it
}

Screenshot BrowserDriver::screenshot(const std::string& keptAs)
{
    const std::string png = fromBase64(call("Page.captureScreenshot").value("data", ""));
    if (const char* folder = std::getenv("SPHERETREE_SCREENSHOTS")) {
        writeText(std::filesystem::path(folder) / (keptAs + ".png"), png);
    }
    return decoded(png);
}

} // namespace command_test
