// SPDX-License-Identifier: Apache-2.0
#include "AnswerSheet.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "TextTable.h"

#include <openvdb_spheretree/base/CsvCell.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/store/JsonWriter.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace command {

using openvdb_spheretree::JsonWriter;

namespace {

constexpr std::size_t kShown = 50; ///< lines of a table for people

std::string tableText(const Cell& cell)
{
    if (const auto* number = std::get_if<double>(&cell)) {
        char text[32];
        std::snprintf(text, sizeof(text), "%.6g", *number);
        return text;
    }
    if (const auto* number = std::get_if<int64_t>(&cell)) return std::to_string(*number);
    if (const auto* truth = std::get_if<bool>(&cell)) return *truth ? "yes" : "no";
    if (const auto* word = std::get_if<const char*>(&cell)) return oneLine(*word, 60);
    return "-";
}

std::string csvText(const Cell& cell)
{
    if (const auto* word = std::get_if<const char*>(&cell)) {
        // In quotes, where it would be taken for more than one field, or for none of the kind.
        return openvdb_spheretree::detail::csvCell(*word, ",;\"\t\r\n ");
    }
    if (const auto* truth = std::get_if<bool>(&cell)) return *truth ? "1" : "0";
    const auto* number = std::get_if<double>(&cell);
    if (!number) return cell.index() == 0 ? "" : tableText(cell);
    if (!std::isfinite(*number)) return "";
    char text[64];
    return std::string(text, std::to_chars(text, text + sizeof(text), *number).ptr);
}

void writeValue(JsonWriter& json, const std::string& key, const Cell& cell)
{
    if (const auto* number = std::get_if<double>(&cell)) json.value(key, *number);
    else if (const auto* whole = std::get_if<int64_t>(&cell)) json.value(key, *whole);
    else if (const auto* truth = std::get_if<bool>(&cell)) json.value(key, *truth);
    else if (const auto* word = std::get_if<const char*>(&cell)) json.value(key, *word);
    else json.null(key);
}

} // namespace

std::string answerTable(const AnswerSheet& sheet, std::size_t columns)
{
    openvdb_spheretree::detail::TextStream out;
    std::vector<Row> rows = {sheet.columns};
    for (std::size_t i = 0; i < std::min(sheet.count, kShown); ++i) {
        Row row;
        for (const Cell& cell : sheet.row(i)) row.push_back(tableText(cell));
        rows.push_back(row);
    }
    printRows(out, rows, /*second=*/4, columns);
    if (sheet.count > kShown) {
        out << "... and " << withCommas(int64_t(sheet.count - kShown))
            << " more: csv= and json= have all of them\n";
    }
    if (!sheet.summary.empty()) out << sheet.summary << "\n";
    return out.str();
}

void writeAnswersCsv(std::ostream& out, const AnswerSheet& sheet)
{
    for (std::size_t i = 0; i < sheet.columns.size(); ++i) {
        out << (i ? "," : "") << sheet.columns[i];
    }
    out << "\n";
    for (std::size_t i = 0; i < sheet.count; ++i) {
        std::string line;
        for (const Cell& cell : sheet.row(i)) line += csvText(cell) + ",";
        line.back() = '\n';
        out << line;
    }
}

void writeAnswersJson(std::ostream& out, const AnswerSheet& sheet)
{
    JsonWriter json;
    json.beginObject();
    json.value("format", sheet.format);
    for (const auto& [key, fact] : sheet.facts) json.value(key, fact);
    json.beginArray("answers");
    for (std::size_t i = 0; i < sheet.count; ++i) {
        json.beginObject();
        const Cells cells = sheet.row(i);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            writeValue(json, sheet.columns[k], cells[k]);
        }
        json.endObject();
        out << json.text();
        json.clearText();
    }
    json.endArray();
    json.endObject();
    out << json.text();
}

} // namespace command
