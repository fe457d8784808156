// SPDX-License-Identifier: Apache-2.0
/// @file DidYouMean.h
/// @brief What is similar to a word that is misspelt.

#pragma once

#include <string>
#include <vector>

namespace command {

/// @return " (did you mean ...?)" with the candidates similar to @a word; empty if there are none.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

} // namespace command
