// SPDX-License-Identifier: Apache-2.0
/// @file OperandFunctions.cc
/// @brief What moves values, and what keeps them under a name.

#include "Functions.h"

#include "base/Errors.h"

#include <openvdb_spheretree/base/Text.h>

namespace command {

namespace {

/// Pops as many values as @a order has, and pushes those it names: 0 is the one below all others.
Function moved(const std::string& name, std::size_t operands, const std::string& doc,
    const std::vector<std::size_t>& order)
{
    return {name, operands, doc, [operands, order](Evaluation& e) {
                std::vector<std::string> values(operands);
                for (std::size_t i = operands; i-- > 0;) values[i] = e.operands.pop();
                for (const std::size_t i : order) e.operands.push(values[i]);
            }};
}

std::string joined(const std::vector<std::string>& values)
{
    std::string all;
    for (const std::string& value : values) all += (&value == values.data() ? "" : ",") + value;
    return all;
}

void squash(Evaluation& e)
{
    if (e.operands.size() == 0) return;
    const std::string all = joined(e.operands.values());
    e.operands.clear();
    e.operands.push(all);
}

void scrape(Evaluation& e)
{
    const std::string last = e.operands.pop();
    e.operands.clear();
    e.operands.push(last);
}

void get(Evaluation& e)
{
    const std::string name = e.operands.pop();
    if (e.variables.isUnknown(name)) throw NeedsStack();
    const auto value = e.variables.get(name);
    if (!value) {
        throwUsage("there is no variable " + openvdb_spheretree::detail::inQuotes(name));
    }
    e.operands.push(*value);
}

} // namespace

std::vector<Function> operandFunctions()
{
    return {
        moved("dup", 1, "{2:dup:*} -> 4: the last value once more", {0, 0}),
        moved("swap", 2, "{1:2:swap:-} -> 1: the last two change places", {1, 0}),
        moved("drop", 1, "{x:y:drop} -> x: without the last", {}),
        moved("nip", 2, "{x:y:nip} -> y: without the one before the last", {1}),
        moved("over", 2, "{x:y:over:squash} -> x,y,x", {0, 1, 0}),
        moved("rot", 3, "{x:y:z:rot:squash} -> y,z,x", {1, 2, 0}),
        moved("tuck", 3, "{x:y:z:tuck:squash} -> z,x,y", {2, 0, 1}),
        {"depth", 0, "{x:y:z:depth:scrape} -> 3: how many values there are",
            [](Evaluation& e) { e.operands.push(Number(int64_t(e.operands.size()))); }},
        {"clear", 0, "{x:y:clear:z} -> z: without all before",
            [](Evaluation& e) { e.operands.clear(); }},
        {"squash", 0, "{x:y:z:squash} -> x,y,z: all as one", squash},
        {"scrape", 1, "{x:y:z:scrape} -> z: the last alone", scrape},
        {"get", 1, "{pi:get} -> 3.141593: a variable, as {$pi}", get},
        {"set", 2, "{1:G:set} stores a variable, as {1:@G}",
            [](Evaluation& e) {
                const std::string name = e.operands.pop();
                e.variables.set(name, e.operands.pop());
            }},
        {"is_set", 1, "{G:is_set} -> 0: whether there is such a variable",
            [](Evaluation& e) {
                const std::string name = e.operands.pop();
                if (e.variables.isUnknown(name)) throw NeedsStack();
                e.operands.push(e.variables.isSet(name));
            }},
    };
}

} // namespace command
