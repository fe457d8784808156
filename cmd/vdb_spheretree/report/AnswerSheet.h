// SPDX-License-Identifier: Apache-2.0
/// @file AnswerSheet.h
/// @brief Answers to many questions, a line each: as a table for people, as CSV and as JSON for programs.
///
/// Rows are made as they are written, so that millions of them take no memory.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace command {

/// A number, a truth or a word (which stays as long as its sheet); nothing is an empty cell of a CSV, null in JSON, and - in a table.
using Cell = std::variant<std::monostate, int64_t, double, bool, const char*>;
using Cells = std::vector<Cell>;

struct AnswerSheet {
    std::string format; ///< of the JSON, such as `vdb_spheretree.collide.1`
    /// What there is to say of all answers: members of the JSON.
    std::vector<std::pair<std::string, std::string>> facts;
    std::vector<std::string> columns;
    std::size_t count = 0;
    std::function<Cells(std::size_t)> row;
    std::string summary; ///< a line for people, below their table; may be empty
};

/// @param columns  of the terminal; 0: any
/// @return the first answers as a table, with a line on how many more there are.
std::string answerTable(const AnswerSheet& sheet, std::size_t columns);

/// Numbers read back to the same value.
void writeAnswersCsv(std::ostream& out, const AnswerSheet& sheet);

/// An object with `format`, the facts and `answers`: an array of objects whose keys are the columns.
void writeAnswersJson(std::ostream& out, const AnswerSheet& sheet);

} // namespace command
