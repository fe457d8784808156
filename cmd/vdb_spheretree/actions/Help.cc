// SPDX-License-Identifier: Apache-2.0
/// @file Help.cc
/// @brief -help, -version and -examples.

#include "Help.h"

#include "base/DidYouMean.h"
#include "line/Actions.h"
#include "session/Session.h"

#include <openvdb_spheretree/base/TextStream.h>

#include <iostream>
#include <string>
#include <vector>

namespace command {

namespace {

constexpr size_t kColumns = 80;
constexpr size_t kIndent = 17;

/// @return the words of a text. A list of choices that is longer than a line is cut behind a `|`.
std::vector<std::string> wordsOf(const std::string& text, size_t width)
{
    std::vector<std::string> words;
    openvdb_spheretree::detail::TextStream in(text);
    for (std::string word; in >> word;) {
        for (size_t bar = 0; word.size() > width; word.erase(0, bar + 1)) {
            bar = word.rfind('|', width - 1);
            if (bar == word.npos) break;
            words.push_back(word.substr(0, bar + 1));
        }
        words.push_back(word);
    }
    return words;
}

/// Prints words until a line is full, then goes on in the next one, indented.
void printWrapped(std::ostream& out, const std::string& text, size_t indent)
{
    size_t column = indent;
    for (const std::string& word : wordsOf(text, kColumns - indent)) {
        if (column > indent && column + 1 + word.size() > kColumns) {
            out << "\n" << std::string(indent, ' ');
            column = indent;
        }
        if (column > indent) {
            out << " ";
            ++column;
        }
        out << word;
        column += word.size();
    }
    out << "\n";
}

std::string padded(const std::string& text, size_t width)
{
    return text.size() < width ? text + std::string(width - text.size(), ' ') : text + " ";
}

std::string docOf(const ActionSpec& action, const OptionSpec& option)
{
    std::string doc = option.doc;
    for (size_t i = 0; i < option.choices.size(); ++i) {
        doc += (i ? "|" : " [") + option.choices[i] + (i + 1 == option.choices.size() ? "]" : "");
    }
    if (!option.fallback.empty()) doc += " (default " + option.fallback + ")";
    if (option.name == action.mainOption && !action.anyName) doc += "; the name may be left out";
    return doc;
}

void printBrief(std::ostream& out, const ActionSpec& action)
{
    const std::string alias = action.alias.empty() ? "" : ",-" + action.alias;
    printEntry(out, "-" + action.name + alias, action.doc);
}

void printAction(std::ostream& out, const ActionSpec& action)
{
    printBrief(out, action);
    for (const OptionSpec& option : action.options) {
        out << "    " << padded(option.name + "=", kIndent - 4);
        printWrapped(out, docOf(action, option), kIndent);
    }
    for (const auto& [term, doc] : action.more) {
        out << "    " << padded(term, kIndent - 4);
        printWrapped(out, doc, kIndent);
    }
    out << "\n";
}

void printGrammar(std::ostream& out)
{
    out << "vdb_spheretree: sphere-trees of OpenVDB grids\n\n"
           "Usage: vdb_spheretree -action [option=value ...] [-action ...]\n\n"
           "Actions run from left to right on a stack of grids, sphere-trees and meshes. An\n"
           "option may be shortened as long as that is unambiguous. Inputs are consumed\n"
           "unless keep=1. '{...}' in a value is an expression (-eval help='*' lists what\n"
           "there is), and #### or %04d in a name is the number of the frame. Exit codes:\n"
           "0 done, 2 usage, 3 input, 4 output, 5 interrupted, 6 a check failed.\n\n";
}

void checkHelp(const ActionCall& call, Plan&)
{
    for (const std::string& name : call.list("actions")) {
        if (findAction(name)) continue;
        std::vector<std::string> names;
        for (const ActionSpec& action : actionTable()) names.push_back(action.name);
        throwUsage("there is no action " + name + didYouMean(name, names));
    }
}

void runHelp(const ActionCall& call, Session& session)
{
    openvdb_spheretree::detail::TextStream out;
    const std::vector<std::string> names = call.list("actions");
    const auto print = call.flag("brief") ? printBrief : printAction;
    if (names.empty()) {
        printGrammar(out);
        for (const ActionSpec& action : actionTable()) print(out, action);
    }
    for (const std::string& name : names) print(out, *findAction(name));
    session.print(out.str());
}

} // namespace

void printEntry(std::ostream& out, const std::string& name, const std::string& doc)
{
    out << padded(name, kIndent);
    printWrapped(out, doc, kIndent);
}

void printUsage(std::ostream& out)
{
    out << "Usage: vdb_spheretree -action [option=value ...] [-action ...]\n"
           "  vdb_spheretree -read object.vdb -spheretree -stats -write tree.vdb\n"
           "Try vdb_spheretree -help, -help spheretree, or -examples.\n";
}

ActionSpec helpAction()
{
    ActionSpec action = smallAction("help", "explain all actions, or those that are named");
    action.alias = "h";
    action.isLiteral = true;
    action.once = true;
    action.mainOption = "actions";
    action.options = {list("actions", "", "names of actions, without a dash"),
        flag("brief", false, "only one line about each")};
    action.check = checkHelp;
    action.run = runHelp;
    return action;
}

ActionSpec versionAction()
{
    ActionSpec action = smallAction("version", "print the versions of this command and of OpenVDB");
    action.alias = "v";
    action.once = true;
    action.run = [](const ActionCall&, Session& session) {
        session.print(std::string("vdb_spheretree ") + SPHERETREE_VERSION + " (OpenVDB "
            + openvdb::getLibraryVersionString() + ")\n");
    };
    return action;
}

ActionSpec examplesAction()
{
    ActionSpec action = smallAction("examples", "print some command lines");
    action.once = true;
    action.run = [](const ActionCall&, Session& session) {
        session.print(
            "The sphere-tree of a grid, as VDB points, with a table of its levels:\n"
            "  vdb_spheretree -read object.vdb -spheretree -stats -write tree.vdb\n"
            "Of a mesh, by way of a level set of 200 voxels:\n"
            "  vdb_spheretree -read mesh.obj -mesh2ls dim=200 -spheretree -write tree.vdb\n"
            "Of the dense part of a fog volume:\n"
            "  vdb_spheretree -read smoke.vdb grids=density -mask threshold=0.1 -spheretree \\\n"
            "      -write tree.vdb tree.csv\n"
            "One level of at most 64 spheres, as a table:\n"
            "  vdb_spheretree -read tree.vdb -level spheres=64 -write level.csv\n"
            "At most 64 spheres inside an object, those that cover the most of it:\n"
            "  vdb_spheretree -read object.vdb -spheretree tree=tight side=inner spheres=64 \\\n"
            "      -stats -write inner.vdb\n"
            "A picture of level 1, and one of the object from the same place:\n"
            "  vdb_spheretree -read tree.vdb -write level1.png level=1\n"
            "  vdb_spheretree -read object.vdb -write object.png\n"
            "Of each frame of a sequence, and of those whose numbers are named:\n"
            "  vdb_spheretree -read smoke_####.vdb -spheretree -write tree_####.vdb\n"
            "  vdb_spheretree -read smoke_####.vdb frames=1-25x2 -spheretree -write tree_####.vdb\n"
            "Of each file of a folder, named after it:\n"
            "  vdb_spheretree -files scans ext=vol -read '{$file}' -spheretree \\\n"
            "      -write '{$file:name}.csv' -end\n"
            "Verify a stored tree against its object:\n"
            "  vdb_spheretree -read object.vdb -read tree.vdb -check\n"
            "Errors and timings for a program:\n"
            "  vdb_spheretree -quiet -read tree.vdb -stats json=-\n"
            "In a pipe with vdb_tool:\n"
            "  vdb_tool -sphere -o stdout.vdb | vdb_spheretree -read stdin.vdb -spheretree \\\n"
            "      -write stdout.vdb | vdb_tool -read stdin.vdb -print\n");
    };
    return action;
}

} // namespace command
