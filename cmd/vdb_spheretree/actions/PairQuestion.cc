// SPDX-License-Identifier: Apache-2.0
#include "PairQuestion.h"

#include "PoseOptions.h"

#include <openvdb_spheretree/base/Text.h>

#include <algorithm>
#include <limits>

namespace command {

using openvdb_spheretree::QueryTree;
using openvdb_spheretree::RigidTransform;
using openvdb_spheretree::detail::shortNumber;

namespace {

/// Metres and millimetres are mistaken for each other most easily.
void noteUnlikeUnits(const PairQuestion& question, Session& session)
{
    constexpr double kMuch = 100;
    const QueryTree &a = question.a(), &b = question.b();
    const double larger = std::max(a.radius(), b.radius());
    const double smaller = std::min(a.radius(), b.radius());
    if (larger > kMuch * smaller) {
        const bool isFirst = a.radius() > b.radius();
        session.note(question.bodies[isFirst ? 0 : 1].name + " is " + shortNumber(larger / smaller)
            + " times as large as " + question.bodies[isFirst ? 1 : 0].name
            + ": are both in one unit of length?");
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const RigidTransform& pose : question.poses) {
        nearest = std::min(nearest, (pose * b.center() - a.center()).length());
    }
    if (nearest > kMuch * (a.radius() + b.radius())) {
        session.note("in every pose the trees are more than a hundred times their size apart: "
                     "are numbers here in their unit of length (units=)?");
    }
}

} // namespace

PairQuestion::PairQuestion(const ActionCall& call, Session& session)
    : bodies(bodiesOf(call, session, 2)), poses(posesOf(call, session)), unit(unitOf(call))
{
    noteUnlikeUnits(*this, session);
}

AnswerSheet PairQuestion::sheet(const std::string& format) const
{
    AnswerSheet sheet;
    sheet.format = format;
    sheet.facts = {{"a", bodies[0].name}, {"b", bodies[1].name}};
    sheet.count = poses.size();
    return sheet;
}

std::vector<OptionSpec> pairOptions(const std::vector<OptionSpec>& own)
{
    std::vector<OptionSpec> options = poseOptions();
    options.insert(options.end(), own.begin(), own.end());
    options.push_back(integer("blocks", "", 1, std::numeric_limits<int32_t>::max(),
        "test no more blocks of eight spheres for a pose than this; what is not known then is "
        "said"));
    return questionOptions(2, options);
}

void checkPair(const ActionCall& call, Plan& plan, const std::string& columns)
{
    checkQuestion(call, plan, 2, "poses", columns);
    checkPoses(call, plan);
}

int64_t blocksOf(const ActionCall& call)
{
    return call.given("blocks") ? call.integer("blocks") : -1;
}

} // namespace command
