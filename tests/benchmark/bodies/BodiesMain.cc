// SPDX-License-Identifier: Apache-2.0
/// @file BodiesMain.cc
/// @brief Questions to two bodies, beside FCL and Bullet in one run:
///
///     spheretree_benchmark_bodies A.vol B.vol [fast|normal|best] [ROUNDS]
///
/// Times are those of the tree of queries; what others take is a multiple of it, and so is a tree over the same
/// leaves by the surface area heuristic (`plain`): what is left is what the sphere-tree itself is worth.

#include "BulletBodies.h"
#include "FclBodies.h"
#include "QueryBodies.h"
#include "QueryTimes.h"

#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace spheretree_benchmark {
namespace {

using namespace openvdb_spheretree;

constexpr int kPoses = 250;

volatile double gAnswer; // so that no answer is left out

class Bench {
public:
    Bench(const QueryBody& a, const QueryBody& b, int rounds)
        : mA(a), mB(b), mFcl(a.mesh, b.mesh), mBullet(a.query, b.query), mRounds(rounds)
    {}

    void run(Stratum stratum)
    {
        mPoses = posesOf(mA, mB, stratum, kPoses);
        mMotions = motionsTo(mA, mB, mPoses);
        mFcl.setPoses(mPoses);
        mFcl.setMotions(mMotions);
        mStratum = kStrata[int(stratum)];
        collision();
        distances();
        allPairs();
        motions();
    }

private:
    using Ask = std::function<double(const QueryTree& a, const QueryTree& b, int i)>;

    /// Of the tree itself and of the plain one, with their mean numbers of blocks.
    std::vector<Contender> ours(
        const std::string& question, const Ask& ask, const Ask& blocks) const
    {
        double tree = 0, plain = 0;
        for (int i = 0; i < kPoses; ++i) {
            tree += blocks(mA.query, mB.query, i) / kPoses;
            plain += blocks(mA.plain, mB.plain, i) / kPoses;
        }
        std::printf(
            "%-10s %-7s %8.1f blocks (plain %.1f)\n", question.c_str(), mStratum, tree, plain);
        return {{"", [this, ask](int i) { gAnswer = ask(mA.query, mB.query, i); }},
            {"plain", [this, ask](int i) { gAnswer = ask(mA.plain, mB.plain, i); }}};
    }

    void print(const std::string& question, const std::vector<Contender>& contenders) const
    {
        printTimes(question + " " + mStratum, contenders, timesOf(contenders, kPoses, mRounds));
    }

    void collision()
    {
        const auto ask = [this](const QueryTree& a, const QueryTree& b, int i) {
            return collide(a, {}, b, mPoses[std::size_t(i)]);
        };
        auto contenders = ours(
            "collide", [=](auto& a, auto& b, int i) { return double(ask(a, b, i).isCollision()); },
            [=](auto& a, auto& b, int i) { return double(ask(a, b, i).blocks); });
        contenders.push_back({"FCL", [this](int i) { gAnswer = mFcl.collide(i); }});
        print("collide", contenders);
    }

    void distances()
    {
        const auto ask = [this](const QueryTree& a, const QueryTree& b, int i) {
            return distance(a, {}, b, mPoses[std::size_t(i)]);
        };
        auto contenders = ours(
            "distance", [=](auto& a, auto& b, int i) { return ask(a, b, i).distance; },
            [=](auto& a, auto& b, int i) { return double(ask(a, b, i).blocks); });
        std::vector<NodePair> near;
        for (const auto& pose : mPoses)
            near.push_back(distance(mA.query, {}, mB.query, pose).contact->nodes);
        contenders.push_back({"warm", [this, near](int i) { // a voxel further
                                  DistanceRequest request;
                                  request.warmStart = near[std::size_t(i)];
                                  RigidTransform pose = mPoses[std::size_t(i)];
                                  pose.move({0.6, 0.6, 0.6});
                                  gAnswer =
                                      distance(mA.query, {}, mB.query, pose, request).distance;
                              }});
        contenders.push_back({"FCL", [this](int i) { gAnswer = mFcl.distance(i); }, 5});
        print("distance", contenders);
    }

    void allPairs()
    {
        const auto ask = [this](const QueryTree& a, const QueryTree& b, int i, std::size_t& pairs) {
            return collideAll(a, {}, b, mPoses[std::size_t(i)], 0,
                [&](const NodePair*, int count) { return (pairs += std::size_t(count)) > 0; });
        };
        auto contenders = ours(
            "all pairs",
            [=](auto& a, auto& b, int i) {
                std::size_t pairs = 0;
                ask(a, b, i, pairs);
                return double(pairs);
            },
            [=](auto& a, auto& b, int i) {
                std::size_t pairs = 0;
                return double(ask(a, b, i, pairs).blocks);
            });
        for (Contender& contender : contenders) contender.every = 10;
        contenders.push_back({"Bullet",
            [this](int i) { gAnswer = double(mBullet.pairs(mPoses[std::size_t(i)])); }, 10});
        contenders.push_back({"FCL", [this](int i) { gAnswer = double(mFcl.allContacts(i)); }, 10});
        print("all pairs", contenders);
    }

    void motions()
    {
        const auto ask = [this](const QueryTree& a, const QueryTree& b, int i) {
            return continuousCollide(a, {}, b, mMotions[std::size_t(i)]);
        };
        auto contenders = ours(
            "screw to", [=](auto& a, auto& b, int i) { return ask(a, b, i).timeOfContact; },
            [=](auto& a, auto& b, int i) { return double(ask(a, b, i).blocks); });
        contenders.push_back(
            {"FCL, 100 samples", [this](int i) { gAnswer = mFcl.timeOfContact(i); }, 10});
        print("screw to", contenders);
    }

    const QueryBody& mA;
    const QueryBody& mB;
    FclBodies mFcl;
    BulletBodies mBullet;
    int mRounds;
    const char* mStratum = "";
    std::vector<RigidTransform> mPoses;
    std::vector<RigidMotion> mMotions;
};

void run(int count, char** arguments)
{
    const std::string name = count > 3 ? arguments[3] : "normal";
    const Quality quality = name == "fast" ? Quality::Fast
        : name == "best"                   ? Quality::Best
                                           : Quality::Normal;
    const QueryBody a = queryBody(arguments[1], quality), b = queryBody(arguments[2], quality);
    std::printf("== %s against %s\n", a.name.c_str(), b.name.c_str());
    for (const QueryBody* body : {&a, &b}) {
        std::printf("%s: %d leaves, %.1f bytes each (plain %.1f); %zu triangles\n",
            body->name.c_str(), body->query.leafCount(),
            double(body->query.bytes()) / body->query.leafCount(),
            double(body->plain.bytes()) / body->plain.leafCount(), body->mesh.triangles.size());
    }
    Bench bench(a, b, count > 4 ? std::atoi(arguments[4]) : 5);
    for (const Stratum stratum : {Stratum::Apart, Stratum::Near, Stratum::Slight, Stratum::Deep})
        bench.run(stratum);
}

} // namespace
} // namespace spheretree_benchmark

int main(int count, char** arguments)
{
    if (count < 3) {
        std::fprintf(stderr, "usage: %s A.vol B.vol [fast|normal|best] [ROUNDS]\n", arguments[0]);
        return 2;
    }
    try {
        spheretree_benchmark::run(count, arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
