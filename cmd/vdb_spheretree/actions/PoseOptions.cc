// SPDX-License-Identifier: Apache-2.0
#include "PoseOptions.h"

#include "base/Errors.h"
#include "QueryOptions.h"

#include <openvdb_spheretree/base/Text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace command {

using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb_spheretree::RigidTransform;

namespace {

/// Radians, or degrees with `deg` behind all of the text.
struct AngleText {
    std::string numbers;
    double radians = 1; ///< of one
    bool hasUnit = false;

    explicit AngleText(const std::string& typed) : numbers(typed)
    {
        const auto cut = [&](const char* unit) {
            const std::size_t size = numbers.size();
            if (size < 3 || numbers.compare(size - 3, 3, unit) != 0) return false;
            numbers.resize(size - 3);
            return true;
        };
        const bool areDegrees = cut("deg");
        if (areDegrees) radians = M_PI / 180;
        hasUnit = areDegrees || cut("rad");
    }
};

std::optional<Vec3d> anglesOf(const std::string& typed)
{
    const AngleText text(typed);
    const auto angles = parseVector(text.numbers);
    if (!angles || typed.size() == 1) return {}; // x, y and z are axes, and no angles
    return Vec3d((*angles)[0], (*angles)[1], (*angles)[2]) * text.radians;
}

std::optional<double> angleOf(const std::string& typed)
{
    const AngleText text(typed);
    const auto number = openvdb_spheretree::detail::parseNumber<double>(text.numbers);
    if (!number || !std::isfinite(*number)) return {};
    return *number * text.radians;
}

/// 16 numbers, or the first 12 of them.
std::optional<std::array<double, 16>> matrixOf(const std::vector<std::string>& typed)
{
    if (typed.size() != 12 && typed.size() != 16) return {};
    std::array<double, 16> matrix = {};
    matrix[15] = 1;
    for (std::size_t i = 0; i < typed.size(); ++i) {
        const auto number = openvdb_spheretree::detail::parseNumber<double>(typed[i]);
        if (!number) return {};
        matrix[i] = *number;
    }
    return matrix;
}

Vec3d vecOf(const std::array<double, 3>& v) { return Vec3d(v[0], v[1], v[2]); }

RigidTransform rotationOf(const ActionCall& call)
{
    if (call.given("rotate")) {
        const Vec3d angles = anglesOf(call.text("rotate")).value();
        return RigidTransform(openvdb_spheretree::rotationOfAngles(angles), Vec3d(0.0));
    }
    if (!call.given("angle")) return {};
    return RigidTransform::fromRotation(
        vecOf(call.vector("axis")), angleOf(call.text("angle")).value());
}

RigidTransform poseOf(const ActionCall& call)
{
    if (call.given("matrix"))
        return RigidTransform::fromMatrix(matrixOf(call.list("matrix")).value());
    return RigidTransform::fromTranslation(vecOf(call.vector("translate"))) * rotationOf(call);
}

void checkAngles(const ActionCall& call)
{
    if (call.given("rotate") && !anglesOf(call.text("rotate"))) {
        throwUsage("rotate=" + call.text("rotate")
            + ": it takes three angles about x, y and z, in radians or with deg behind the last, "
              "such as "
              "0,0,90deg");
    }
    if (call.given("angle") && !angleOf(call.text("angle"))) {
        throwUsage("angle=" + call.text("angle") + ": it takes radians, or degrees as 90deg");
    }
    if (call.given("axis") && vecOf(call.vector("axis")) == Vec3d(0.0)) {
        throwUsage("axis=" + call.text("axis") + " has no length");
    }
    if (call.given("axis") != call.given("angle")) {
        throwUsage("axis and angle turn together: give both");
    }
    if (call.given("rotate") && call.given("angle")) {
        throwUsage("rotate and angle exclude each other");
    }
}

void checkMatrix(const ActionCall& call)
{
    if (!call.given("matrix")) return;
    for (const char* other : {"translate", "rotate", "angle"}) {
        if (call.given(other)) {
            throwUsage(std::string("matrix and ") + other + " exclude each other");
        }
    }
    if (!matrixOf(call.list("matrix"))) {
        throwUsage("matrix=" + call.text("matrix")
            + ": it takes 16 numbers, row by row, or the 12 of the first three rows");
    }
}

/// Says so where angles were hardly meant as radians.
void noteLargeAngles(const ActionCall& call, Session& session)
{
    const auto note = [&](const std::string& name, double largest) {
        const std::string typed = call.text(name);
        if (!(largest > openvdb_spheretree::kFullTurn) || AngleText(typed).hasUnit) return;
        session.note(name + "=" + typed + " is in radians, and turns by more than once around: "
            + typed + "deg would be degrees, and " + typed + "rad is what it is now");
    };
    if (call.given("rotate")) {
        const Vec3d angles = anglesOf(call.text("rotate")).value();
        note("rotate", std::max({std::abs(angles[0]), std::abs(angles[1]), std::abs(angles[2])}));
    }
    if (call.given("angle")) note("angle", std::abs(angleOf(call.text("angle")).value()));
}

} // namespace

std::vector<OptionSpec> poseOptions()
{
    return {vector("translate", "0,0,0", "move the second tree by this"),
        text("rotate", "",
            "and before that, turn it by these three angles about the x, y and z axis of the "
            "world, "
            "one after the other: radians, or 0,0,90deg"),
        vector("axis", "", "in place of that: the axis that it turns about, such as z or 1,1,0"),
        text("angle", "", "by how much: radians, or 90deg"),
        list("matrix", "",
            "in place of all of it: a 4x4 matrix row by row, of a rotation and a move in its last "
            "column; its last row may be left out"),
        real("scale", "1", 1e-12, 1e12, "make the second tree larger, before anything else"),
        tableOption("poses", "in place of one pose, those")};
}

std::vector<std::pair<std::string, std::string>> poseColumnDocs()
{
    return {{"poses",
        "x,y,z; x,y,z,qx,qy,qz,qw (a quaternion); x,y,z,rx,ry,rz (radians, as "
        "rotate=); or m00,m01,...,m23 (rows of a matrix). Without a header: 3, 7, 12 "
        "or 16 columns of these"}};
}

void checkPoses(const ActionCall& call, Plan& plan)
{
    checkTable(call, plan, "poses", {"translate", "rotate", "axis", "angle", "matrix"});
    checkAngles(call);
    checkMatrix(call);
    try {
        poseOf(call);
    } catch (...) { // what is not rigid
        rethrowNamed("", kUsage);
    }
}

std::vector<RigidTransform> posesOf(const ActionCall& call, Session& session)
{
    noteLargeAngles(call, session);
    std::vector<RigidTransform> poses = {poseOf(call)};
    if (call.given("poses")) {
        poses = rowsOf(call, "poses", session, openvdb_spheretree::readPoseTable);
    }
    const double unit = unitOf(call);
    if (unit == 1) return poses;
    for (RigidTransform& pose : poses) {
        pose = RigidTransform(pose.rotation(), pose.translation() * unit);
    }
    return poses;
}

} // namespace command
