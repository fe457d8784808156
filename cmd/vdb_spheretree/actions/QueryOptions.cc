// SPDX-License-Identifier: Apache-2.0
#include "QueryOptions.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "files/InputStamp.h"
#include "files/SpooledInput.h"
#include "line/Length.h"
#include "ReportFiles.h"

#include <openvdb_spheretree/base/Text.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

namespace command {

namespace spheretree = openvdb_spheretree;
using openvdb_spheretree::QueryTable;
using openvdb_spheretree::QueryTreeSettings;

namespace {

/// @return for messages, which trees of the stack are left out, as they have no spheres; nothing if all have some.
std::string withoutSpheres(const Session& session)
{
    std::string all;
    for (const auto& item : session.stack.items()) {
        if (item->emptyTree) all += (all.empty() ? "; left out: " : ", ") + item->description();
    }
    return all;
}

/// All trees, or those of vdb=, each once.
std::vector<const StackItem*> anyItemsOf(const ActionCall& call, Session& session)
{
    std::vector<const StackItem*> items;
    const std::vector<std::string> names = call.list("vdb");
    if (names.empty() || names == std::vector<std::string>{"*"}) {
        for (const auto& item : session.stack.items()) {
            if (item->tree) items.push_back(item.get());
        }
    } else {
        for (const std::string& name : names) {
            const StackItem* const item = &session.stack.selectTree(name);
            if (std::count(items.begin(), items.end(), item)) {
                throwInput(item->description()
                    + " is named twice by vdb=: read it twice to have two of it");
            }
            items.push_back(item);
        }
    }
    if (items.size() < 2) {
        throwInput("asks two sphere-trees or more, and there "
            + std::string(items.empty() ? "is none" : "is one") + ": read others"
            + withoutSpheres(session));
    }
    return items;
}

/// Items of the stack, the first body first.
std::vector<const StackItem*> itemsOf(const ActionCall& call, Session& session, int trees)
{
    if (trees == kAnyTrees) return anyItemsOf(call, session);
    std::vector<const StackItem*> items;
    if (call.given("vdb") || trees == 1) {
        const std::vector<std::string> names = call.list("vdb");
        if (names.empty()) return {&session.stack.selectTree("")};
        for (const std::string& name : names) items.push_back(&session.stack.selectTree(name));
        return items;
    }
    for (const auto& item : session.stack.items()) {
        if (item->tree) items.push_back(item.get());
    }
    if (items.size() == 1) {
        throwInput("asks two sphere-trees, and there is one: read another one, or ask it against "
                   "itself with vdb=0,0"
            + withoutSpheres(session));
    }
    if (items.size() != 2) {
        throwInput("asks two sphere-trees, and there are " + std::to_string(items.size())
            + (items.empty() ? ": make them with -spheretree"
                             : ": choose with vdb=, the one that stays first, such as vdb=1,0"
                        + std::string(
                            call.spec().option("scene") ? ", or ask all with scene=1" : ""))
            + withoutSpheres(session));
    }
    return items;
}

std::optional<int> levelOf(const ActionCall& call, std::size_t place)
{
    const std::vector<std::string> levels = call.list("level");
    if (levels.empty()) return {};
    return spheretree::detail::parseNumber<int>(levels[std::min(place, levels.size() - 1)]);
}

void checkLevels(const ActionCall& call, int trees)
{
    const std::vector<std::string> levels = call.list("level");
    for (const std::string& level : levels) {
        const auto number = spheretree::detail::parseNumber<int>(level);
        if (number && *number >= 0 && *number <= 1000) continue;
        throwUsage("level=" + call.text("level") + ": a level is a whole number, 0 to 1000");
    }
    if (trees != kAnyTrees && int(levels.size()) > trees) {
        throwUsage("level=" + call.text("level") + " names more levels than there are trees");
    }
}

QueryTreeSettings settingsOf(const ActionCall& call, const StackItem& item, int place, bool isLast)
{
    QueryTreeSettings settings;
    const auto& tree = *item.tree;
    const auto level = levelOf(call, std::size_t(place));
    if (level && !tree.hasLevel(*level)) {
        throwInput(item.description() + " has no level " + std::to_string(*level)
            + ": it has levels " + std::to_string(tree.levels.front().level) + " to "
            + std::to_string(tree.root().level));
    }
    settings.level = level.value_or(-1);
    if (call.flag("exact")) settings.exactness = spheretree::Exactness::LeafUnion;
    const bool isReversible =
        tree.settings.type() == spheretree::TreeType::Reversible && tree.levels.size() > 1;
    if (isReversible && !call.flag("exact")) {
        throwInput(item.description()
            + ": spheres of a reversible tree do not hold those below them: add exact=1, which "
              "makes a hierarchy over its leaves, or build a tight tree");
    }
    if (isLast && call.spec().option("scale")) settings.scale = call.real("scale");
    return settings;
}

/// Whoever forgets `poses=` would have the poses replaced by answers.
/// @throw CommandError (usage) if there is such a file, and it holds no answers
void requireOwnAnswers(
    const std::string& path, const std::string& table, const std::string& columns)
{
    std::ifstream file(path);
    std::string start(columns.size(), 0);
    file.read(start.data(), std::streamsize(start.size()));
    if (file.gcount() == 0 || start == columns) return;
    throwUsage(path + " is there, and holds no answers of this kind: to ask what it holds, write "
        + table + "=" + path + "; to replace it by answers, csv=" + path);
}

QueryBody bodyOf(const StackItem& item, const QueryTreeSettings& settings)
{
    try {
        return {item.name(), item.tree.get(), settings,
            spheretree::makeQueryTree(*item.tree, settings)};
    } catch (...) {
        rethrowNamed(item.description(), kInput);
    }
}

} // namespace

std::vector<OptionSpec> questionOptions(int trees, const std::vector<OptionSpec>& own)
{
    const bool two = trees == 2;
    std::vector<OptionSpec> options =
        reportOptions("in place of a table, .json or .csv files of all answers",
            "the answers as JSON to this file, or to stdout (-)",
            "the answers as a CSV to this file, or to stdout (-)");
    options.insert(options.begin() + 1, own.begin(), own.end());
    options.push_back(list("level", "",
        two ? "the level whose spheres are asked, or one of each tree, such as 0,2; by default the "
              "finest"
            : "the level whose spheres are asked; by default the finest"));
    options.push_back(flag("exact", false,
        "answers are exactly those of the level's spheres; of a tree whose spheres do not hold "
        "those below, a hierarchy is made anew, and answers are a little farther from the object"));
    std::vector<std::string> names;
    for (const auto& unit : unitsOfLength()) names.push_back(unit.first);
    OptionSpec units = choice("units", names,
        "the unit of all numbers here, typed, read and answered: the trees are in metres then");
    units.fallback.clear();
    options.push_back(units);
    options.push_back(two
            ? list("vdb", "",
                "the two trees, by their age on the stack (0 is the newest) or name, the one that "
                "stays first; by default the only two that there are")
            : vdbOption("the tree"));
    return options;
}

void checkQuestion(const ActionCall& call, Plan& plan, int trees, const std::string& table,
    const std::string& columns)
{
    checkReportFiles(call, plan);
    for (const std::string& path : call.list("files")) {
        if (fileKind(path) == FileKind::Csv) requireOwnAnswers(path, table, columns);
    }
    checkLevels(call, trees);
    if (trees == 2 && call.given("vdb") && call.list("vdb").size() != 2) {
        throwUsage("vdb=" + call.text("vdb") + ": name two trees, such as vdb=1,0");
    }
}

std::vector<QueryBody> bodiesOf(const ActionCall& call, Session& session, int trees)
{
    std::vector<QueryBody> bodies;
    const auto items = itemsOf(call, session, trees);
    if (call.list("level").size() > items.size()) {
        throwInput("level=" + call.text("level") + " names more levels than there are trees");
    }
    for (const StackItem* item : items) {
        session.noteIfUnverified(*item);
        const int place = int(bodies.size());
        bodies.push_back(bodyOf(*item, settingsOf(call, *item, place, place + 1 == trees)));
        const auto& tree = bodies.back().tree;
        if (!tree.holdsObject() && !tree.holdsLeaves()) {
            session.note(item->description()
                + ": its spheres hold neither the voxels of the object nor the spheres below them, "
                  "so something may be missed; exact=1 has the answers of its leaf spheres");
        }
    }
    return bodies;
}

double unitOf(const ActionCall& call)
{
    return call.given("units") ? metresOfUnit(call.text("units")).value() : 1;
}

double lengthOf(const ActionCall& call, const std::string& option)
{
    const bool hasUnit = parseLength(call.text(option)).has_value();
    return call.length(option) * (hasUnit ? 1 : unitOf(call));
}

OptionSpec tableOption(const std::string& name, const std::string& doc)
{
    return text(
        name, "", doc + " of a .csv or .txt, one a line, or of stdin.csv; columns are below");
}

void checkTable(const ActionCall& call, Plan& plan, const std::string& name,
    const std::vector<std::string>& others)
{
    if (!call.given(name)) return;
    const std::string path = call.text(name);
    const bool isTable = fileKind(path) == FileKind::Csv
        || openvdb_spheretree::detail::lowerExtension(path) == ".txt"; // as TUM and KITTI have it
    if (!isTable) {
        throwUsage(name + "=" + path + ": " + name + " are read from a .csv or .txt");
    }
    for (const std::string& other : others) {
        if (call.given(other)) throwUsage(name + " and " + other + " exclude each other");
    }
    plan.addInput(path);
}

template <typename Row>
std::vector<Row> rowsOf(const ActionCall& call, const std::string& name, Session& session,
    QueryTable<Row> (*read)(const std::string&, const std::string&))
{
    const std::string path = call.text(name);
    std::optional<SpooledInput> spooled;
    std::optional<InputStamp> stamp;
    if (isStdin(path)) spooled.emplace(path);
    else stamp.emplace(path);
    QueryTable<Row> table = read(spooled ? spooled->path() : path, path);
    if (stamp) stamp->requireUnchanged();
    if (!table.assumption.empty()) session.note(table.assumption);
    return std::move(table.rows);
}

template std::vector<spheretree::RigidTransform> rowsOf(const ActionCall&, const std::string&,
    Session&, QueryTable<spheretree::RigidTransform> (*)(const std::string&, const std::string&));
template std::vector<spheretree::BodyPose> rowsOf(const ActionCall&, const std::string&, Session&,
    QueryTable<spheretree::BodyPose> (*)(const std::string&, const std::string&));
template std::vector<openvdb::Vec3d> rowsOf(const ActionCall&, const std::string&, Session&,
    QueryTable<openvdb::Vec3d> (*)(const std::string&, const std::string&));
template std::vector<spheretree::QueryRay> rowsOf(const ActionCall&, const std::string&, Session&,
    QueryTable<spheretree::QueryRay> (*)(const std::string&, const std::string&));

Cell lengthCell(double length, double unit)
{
    return std::isfinite(length) ? Cell(length / unit) : Cell();
}

void addCells(Cells& cells, const openvdb::Vec3d& vec, double unit)
{
    for (int axis = 0; axis < 3; ++axis) cells.push_back(vec[axis] / unit);
}

void addNothing(Cells& cells, int count) { cells.insert(cells.end(), std::size_t(count), Cell()); }

void addContact(Cells& cells, const spheretree::Contact* contact, double unit)
{
    if (!contact) return addNothing(cells, 8);
    addCells(cells, contact->point(), unit);
    addCells(cells, contact->normal);
    cells.insert(cells.end(), {int64_t(contact->nodes.a), int64_t(contact->nodes.b)});
}

void giveAnswers(const ActionCall& call, Session& session, const AnswerSheet& sheet)
{
    if (!hasReportFiles(call)) {
        return session.print(answerTable(sheet, terminalColumns(session.textOut())));
    }
    writeReportFiles(call, session, [&](std::ostream& out, const std::string& form) {
        if (form == "csv") writeAnswersCsv(out, sheet);
        else writeAnswersJson(out, sheet);
    });
}

} // namespace command
