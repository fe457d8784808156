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

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
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

/// The first error of questions that are asked in parallel, whichever came first.
class FirstError {
public:
    /// @return where it is; the largest number if there is none.
    std::size_t place() const { return mPlace; }
    /// Notes the exception that is being handled.
    void note(std::size_t place)
    {
        const std::lock_guard<std::mutex> lock(mMutex);
        if (place >= mPlace) return;
        mPlace = place;
        mError = std::current_exception();
    }
    /// @throw CommandError (input) that begins with @a where; there must be an error
    [[noreturn]] void rethrow(const std::string& where) const
    {
        try {
            std::rethrow_exception(mError);
        } catch (...) {
            rethrowNamed(where, kInput);
        }
    }

private:
    std::mutex mMutex;
    std::atomic<std::size_t> mPlace{SIZE_MAX};
    std::exception_ptr mError;
};

/// @param name  of the number of a question: what it is asked of, such as "pose 3". Messages say it, if there are several
/// @param ask   of the number of a question
/// @return the answers, asked in parallel
/// @throw CommandError (input) if one cannot be given: the first of them
template <typename Result, typename Name, typename Ask>
std::vector<Result> answersOf(std::size_t count, const Name& name, Session& session, const Ask& ask)
{
    std::vector<Result> results(count);
    FirstError error;
    openvdb_spheretree::detail::parallelFor(count, &session.progress, [&](std::size_t i) {
        if (i > error.place()) return;
        try {
            results[i] = ask(i);
        } catch (const openvdb::ValueError&) {
            error.note(i);
        }
    });
    if (error.place() < count) error.rethrow(count == 1 ? "" : name(error.place()));
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
