// SPDX-License-Identifier: Apache-2.0
/// @file LoopActions.cc
/// @brief -for, -each, -files, -if and -end, whose work is in script/; and -onerror.

#include "line/Actions.h"
#include "session/Session.h"

namespace command {

namespace {

ActionSpec blockAction(const std::string& name, Block block, const std::string& doc)
{
    ActionSpec action = smallAction(name, doc);
    action.block = block;
    return action;
}

} // namespace

ActionSpec forAction()
{
    ActionSpec action = blockAction("for", Block::For,
        "do what is between this and its -end for each number of a range: '{$i}' is the number, "
        "'{$#i}' counts from 0, and #### or %04d in names is the number too");
    action.anyName = true;
    action.options = {words("i",
        "first and end, such as i=1,26, which ends with 25, and a step, such as "
        "i=0,1,0.1; the variable may have any name")};
    return action;
}

ActionSpec eachAction()
{
    ActionSpec action = blockAction("each", Block::Each,
        "do what is between this and its -end for each value of a list: '{$s}' is the value");
    action.anyName = true;
    action.mainOption = "s";
    action.options = {words("s", "values, such as s=bunny,dragon; the variable may have any name")};
    return action;
}

ActionSpec filesAction()
{
    ActionSpec action = blockAction("files", Block::Files,
        "do what is between this and its -end for each file of a folder, by name: '{$file}' is its "
        "path");
    action.mainOption = "path";
    action.options = {list("path", "", "folders"),
        list("extension", "", "only files with one of these extensions, such as vdb,vol"),
        list("include", "", "only files with one of these in their names"),
        list("exclude", "", "no files with one of these in their names"),
        flag("recursive", false, "in folders below, too")};
    return action;
}

ActionSpec ifAction()
{
    ActionSpec action = blockAction("if", Block::If,
        "do what is between this and its -end if the test holds, such as '{$i:3:>}' or "
        "'{0:voxelCount:1000:>}'");
    action.mainOption = "test";
    action.options = {text("test", "", "1, 0, true or false")};
    return action;
}

ActionSpec endAction()
{
    return blockAction("end", Block::End, "the end of -for, -each, -files or -if");
}

ActionSpec onerrorAction()
{
    ActionSpec action = smallAction("onerror",
        "after a frame of a loop that has failed: continue with the others, and name it at the "
        "end; or "
        "stop. What cannot be written always ends the loop");
    action.mainOption = "then";
    action.options = {choice("then", {"continue", "stop"}, "what comes then")};
    action.run = [](const ActionCall& call, Session& session) {
        session.stopsAtErrors = call.text("then") == "stop";
    };
    return action;
}

} // namespace command
