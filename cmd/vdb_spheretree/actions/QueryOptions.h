// SPDX-License-Identifier: Apache-2.0
/// @file QueryOptions.h
/// @brief What questions to trees share: which trees of the stack, and of what unit; batches from files; where answers
/// go.

#pragma once

#include "line/Action.h"
#include "report/AnswerSheet.h"
#include "session/Session.h"

#include <openvdb_spheretree/query/Contact.h>
#include <openvdb_spheretree/query/QueryTables.h>
#include <openvdb_spheretree/query/QueryTree.h>

#include <string>
#include <vector>

namespace command {

/// A tree of the stack, made ready for questions.
struct QueryBody {
    std::string name;
    const openvdb_spheretree::SphereTree* spheres;
    openvdb_spheretree::QueryTreeSettings settings;
    openvdb_spheretree::QueryTree tree;
};

/// Of a question that is put to as many trees as there are: two or more.
constexpr int kAnyTrees = -1;

/// @name Options of all questions: files of answers, the trees, their level and unit
/// @{
/// @param trees  how many a question is put to, or kAnyTrees
/// @param own    those of the action alone, which come first behind files=
std::vector<OptionSpec> questionOptions(int trees, const std::vector<OptionSpec>& own);
/// @param columns  how the header of the action's own tables begins: a table of another kind is not taken for one of
///                 answers, and written over
/// @throw CommandError (usage or output)
void checkQuestion(const ActionCall& call, Plan& plan, int trees, const std::string& table,
    const std::string& columns);
/// @return the trees that a question is put to, the first body first. The second one is scaled, if `scale` is an option.
/// @param trees  kAnyTrees: all of the stack, the oldest first, or those of vdb=, each once
/// @throw CommandError (input)
std::vector<QueryBody> bodiesOf(const ActionCall& call, Session& session, int trees);

/// @return what numbers that are typed or read are to be multiplied by, and answers to be divided by: metres a unit
///         with units=, else 1.
double unitOf(const ActionCall& call);
/// @return a length that was typed, in the unit of the trees.
double lengthOf(const ActionCall& call, const std::string& option);
/// @}

/// @name Files of a batch, one question a line
/// @{
OptionSpec tableOption(const std::string& name, const std::string& doc);
/// @brief Check a file of a batch, and that nothing else is said beside it.
/// @param others  options that it stands in the place of
/// @throw CommandError (usage or input)
void checkTable(const ActionCall& call, Plan& plan, const std::string& name,
    const std::vector<std::string>& others);
/// @brief Read such a file, which may be standard input.
/// @param read  of QueryTables.h
/// @throw CommandError (input) that names file and line
template <typename Row>
std::vector<Row> rowsOf(const ActionCall& call, const std::string& name, Session& session,
    openvdb_spheretree::QueryTable<Row> (*read)(const std::string&, const std::string&));
/// @}

/// @name Cells of answers
/// @{
Cell lengthCell(double length, double unit); ///< nothing where it is infinite
void addCells(Cells& cells, const openvdb::Vec3d& vec, double unit = 1);
void addNothing(Cells& cells, int count);
/// Where two spheres meet, and which: the columns from `x` to `b`. Nothing for null.
void addContact(Cells& cells, const openvdb_spheretree::Contact* contact, double unit);
/// @}

/// @brief Print the answers, or write them to the files that were asked for.
/// @throw CommandError (output)
void giveAnswers(const ActionCall& call, Session& session, const AnswerSheet& sheet);

} // namespace command
