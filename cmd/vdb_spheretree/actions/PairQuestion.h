// SPDX-License-Identifier: Apache-2.0
/// @file PairQuestion.h
/// @brief What -collide and -distance share: two trees, and where the second one is, in one pose or in many.

#pragma once

#include "base/Errors.h"
#include "line/Action.h"
#include "line/Plan.h"
#include "QueryOptions.h"
#include "session/Session.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/query/RigidTransform.h>

#include <openvdb/Exceptions.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace command {

/// The two bodies of a question and where the second one is.
struct PairQuestion {
    std::vector<QueryBody> bodies;
    std::vector<openvdb_spheretree::RigidTransform> poses;
    double unit;

    /// @throw CommandError (input)
    PairQuestion(const ActionCall& call, Session& session);

    const openvdb_spheretree::QueryTree& a() const { return bodies[0].tree; }
    const openvdb_spheretree::QueryTree& b() const { return bodies[1].tree; }

    AnswerSheet sheet(const std::string& format) const;
};

/// Names things by their numbers, from 0.
inline auto numbered(const char* what)
{
    return [what](std::size_t i) { return what + (" " + std::to_string(i)); };
}

/// @param name  of the number of a question: what it is asked of, such as "pose 3". Messages say it, if there are several
/// @param ask   of the number of a question
/// @return the answers, asked in parallel
/// @throw CommandError (input) if one cannot be given
template <typename Result, typename Name, typename Ask>
std::vector<Result> answersOf(std::size_t count, const Name& name, Session& session, const Ask& ask)
{
    std::vector<Result> results(count);
    openvdb_spheretree::detail::parallelFor(count, &session.progress, [&](std::size_t i) {
        try {
            results[i] = ask(i);
        } catch (const openvdb::ValueError&) {
            rethrowNamed(count == 1 ? "" : name(i), kInput);
        }
    });
    return results;
}

/// @return options of the action alone, and those of all questions to two trees.
std::vector<OptionSpec> pairOptions(const std::vector<OptionSpec>& own);
/// @param columns  how answers begin
/// @throw CommandError (usage, input or output)
void checkPair(const ActionCall& call, Plan& plan, const std::string& columns);
/// @return blocks=, or -1.
int64_t blocksOf(const ActionCall& call);

} // namespace command
