// SPDX-License-Identifier: Apache-2.0
/// @file BrowserDriver.h
/// @brief A page in headless Chromium that is driven from outside, by the DevTools protocol over a pipe: its mouse is
/// one to the browser, and no script's. https://chromedevtools.github.io/devtools-protocol/tot/

#pragma once

#include "CommandRunner.h"

#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace command_test {

/// Red, green and blue of each pixel, 0 to 255, by rows from above.
struct Screenshot {
    int width = 0, height = 0;
    std::vector<std::array<int, 3>> pixels;

    /// @param right,down  shares of the width and the height
    const std::array<int, 3>& at(double right, double down) const;
};

struct DrivenBrowser {
    std::vector<std::string> flags; ///< of the browser's command line
    std::string colorScheme;        ///< of the system: "light" or "dark"
    std::string hash;               ///< what stands behind # in the address
};

class BrowserDriver {
public:
    /// Starts the browser and waits until the page is there. What goes wrong is a failure of the test, and then all calls
    /// give nothing.
    explicit BrowserDriver(const std::filesystem::path& page, const DrivenBrowser& options = {});
    ~BrowserDriver();

    BrowserDriver(const BrowserDriver&) = delete;
    BrowserDriver& operator=(const BrowserDriver&) = delete;

    /// @return the value of an expression of JavaScript in the page; of a promise what it promises.
    nlohmann::json value(const std::string& expression);

    /// From now on the system prefers "light" or "dark".
    void setColorScheme(const std::string& scheme);

    /// @name The mouse, at pixels from the window's left and top
    /// @{
    void moveTo(double x, double y);
    void click(double x, double y);
    void drag(double x, double y, double toX, double toY);
    void wheel(double x, double y, double down);
    /// @}

    /// As the window is seen; also kept as @a keptAs where the environment names a folder for pictures,
    /// SPHERETREE_SCREENSHOTS, for people to look at.
    Screenshot screenshot(const std::string& keptAs);

    /// @return what the page had the browser complain of, a line each.
    const std::string& console() const { return mConsole; }

private:
    /// A pipe's ends for both processes.
    struct Pipe {
        int read = -1, write = -1;
    };
    static Pipe makePipe();

    /// @return the result of a method; null if it fails.
    nlohmann::json call(
        const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
    /// @return the next message of the browser; nothing within a minute is a failure.
    nlohmann::json nextMessage();
    void takeEvent(const nlohmann::json& message);
    void mouse(const std::string& type, double x, double y, const nlohmann::json& more);

    std::filesystem::path mProfile;
    Pipe mTo, mFrom;
    std::optional<Running> mBrowser;
    std::string mReceived, mSession, mConsole;
    int mCalls = 0;
    bool mIsLoaded = false, mHasFailed = false;
};

} // namespace command_test
