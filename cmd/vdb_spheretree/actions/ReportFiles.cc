// SPDX-License-Identifier: Apache-2.0
#include "ReportFiles.h"

#include "base/Errors.h"
#include "base/LastWords.h"
#include "base/Terminal.h"
#include "files/AtomicFile.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <memory>
#include <utility>

namespace command {

namespace {

std::string takes(const ActionCall& call)
{
    return call.label() + " writes .json or .csv, or to stdout with json=- or csv=-";
}

/// @return "json" or "csv", for a file that is named without saying which.
std::string formOf(const ActionCall& call, const std::string& path)
{
    const std::string extension = openvdb_spheretree::detail::lowerExtension(path);
    if (extension == ".csv") return "csv";
    if (extension == ".json" || extension.empty()) return "json";
    throwUsage(path + ": " + takes(call));
}

/// @return the files of a call, each with its form.
std::vector<std::pair<std::string, std::string>> filesOf(const ActionCall& call)
{
    std::vector<std::pair<std::string, std::string>> files;
    for (const std::string& path : call.list("files")) {
        files.emplace_back(path, formOf(call, path));
    }
    for (const char* form : {"json", "csv"}) {
        if (call.given(form)) files.emplace_back(call.text(form), form);
    }
    return files;
}

} // namespace

std::vector<OptionSpec> reportOptions(
    const std::string& files, const std::string& json, const std::string& csv)
{
    return {list("files", "", files), text("json", "", json), text("csv", "", csv)};
}

void checkReportFiles(const ActionCall& call, Plan& plan)
{
    for (const auto& [path, form] : filesOf(call)) {
        const FileKind kind = fileKind(path);
        const FileKind own = form == "csv" ? FileKind::Csv : FileKind::Json;
        if (kind != own && kind != FileKind::Unknown) {
            throwUsage(
                form + "=" + path + ": files of this name are something else; " + takes(call));
        }
        plan.addOutput(path);
    }
}

bool hasReportFiles(const ActionCall& call)
{
    return call.given("files") || call.given("json") || call.given("csv");
}

void writeReportFiles(const ActionCall& call, Session& session,
    const std::function<void(std::ostream& out, const std::string& form)>& write)
{
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (const auto& [path, form] : filesOf(call)) {
        if (isStdout(path)) {
            openvdb_spheretree::detail::TextStream text;
            write(text, form);
            session.print(text.str(), standardOutput());
            continue;
        }
        session.warnIfReplaced(path);
        files.push_back(std::make_unique<AtomicFile>(path));
        files.back()->write([&, form = form](std::ostream& out) { write(out, form); });
    }
    const Uninterrupted untilAllAreThere;
    throwIfStopped();
    for (const auto& file : files) file->commit();
}

} // namespace command
