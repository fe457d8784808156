// SPDX-License-Identifier: Apache-2.0
/// @file BrowserPage.h
/// @brief A page in headless Chromium, without a network or a graphics card: a script drives it, and
/// hands back what it found as JSON.

#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace command_test {

/// @return the browser's name as a command; empty if none is installed.
std::string browser();

/// @return the bytes that a text in base64 stands for, up to the first letter that belongs to none.
std::string fromBase64(const std::string& text);

struct BrowserResult {
    nlohmann::json report; ///< what the script gave to `report`, an object; null if it gave none
    std::string console;   ///< what the page had the browser complain of, a line each
    std::string log;       ///< all that the browser said, for messages
};

/// @brief Open a page, and run a script in it once its own have run.
/// @param page    the file
/// @param script  the body of an async function, with some helpers (BrowserPage.cc); what it throws is
///                `report.failure`
/// @param hash    what stands behind # in the address
BrowserResult openPage(
    const std::filesystem::path& page, const std::string& script, const std::string& hash = {});

} // namespace command_test
