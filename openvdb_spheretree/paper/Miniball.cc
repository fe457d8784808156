// SPDX-License-Identifier: Apache-2.0
#include "Miniball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Vec3d;

/// A pivot adds one to the balls that decide, which are four at most.
constexpr int kMostDeciding = 4;

/// Balls that a smallest ball may be decided by, next to one another.
struct Few {
    std::array<RealBall, kMostDeciding + 1> balls;
    int count = 0;

    void add(const RealBall& ball) { balls[count++] = ball; }
};

double reach(const Vec3d& from, const RealBall& ball)
{
    return (ball.center - from).length() + ball.radius;
}

/// Solves symmetric systems of up to three equations by elimination, with two right-hand sides. The
/// solutions are then in @a right.
/// @return false if there is none to rely on
bool solve(double (&matrix)[3][3], double (&right)[3][2], int count)
{
    double largest = 0;
    for (int i = 0; i < count; ++i) largest = std::max(largest, matrix[i][i]);
    for (int column = 0; column < count; ++column) {
        int pivot = column;
        for (int row = column + 1; row < count; ++row) {
            if (std::abs(matrix[row][column]) > std::abs(matrix[pivot][column])) pivot = row;
        }
        if (!(std::abs(matrix[pivot][column]) > 1e-13 * largest)) return false;
        std::swap(matrix[pivot], matrix[column]);
        std::swap(right[pivot], right[column]);
        for (double& value : right[column]) value /= matrix[column][column];
        for (int j = count; j-- > column;) matrix[column][j] /= matrix[column][column];
        for (int row = 0; row < count; ++row) {
            const double times = matrix[row][column];
            if (row == column || times == 0) continue;
            for (int j = column; j < count; ++j) matrix[row][j] -= times * matrix[column][j];
            for (int j = 0; j < 2; ++j) right[row][j] -= times * right[column][j];
        }
    }
    return true;
}

/// The centers, at most two, of balls that touch each of @a few from outside and lie in their hull.
/// With x = c - c_0, q_i = c_i - c_0, s_i = r_i - r_0 and rho = R - r_0, |x - q_i| = rho - s_i is
///     q_i . x = (|q_i|^2 - s_i^2) / 2 + rho s_i
/// so x, a sum of q_i, is a + rho b; and |x| = rho.
int touchingCenters(const Few& few, std::array<Vec3d, 2>& centers)
{
    const RealBall& first = few.balls[0];
    Vec3d q[3];
    double matrix[3][3], right[3][2];
    const int others = few.count - 1;
    for (int i = 0; i < others; ++i) q[i] = few.balls[i + 1].center - first.center;
    for (int i = 0; i < others; ++i) {
        const double s = few.balls[i + 1].radius - first.radius;
        for (int j = 0; j < others; ++j) matrix[i][j] = q[i].dot(q[j]);
        right[i][0] = (q[i].lengthSqr() - s * s) / 2;
        right[i][1] = s;
    }
    if (!solve(matrix, right, others)) return 0;
    Vec3d a(0.0), b(0.0);
    for (int i = 0; i < others; ++i) {
        a += q[i] * right[i][0];
        b += q[i] * right[i][1];
    }
    // (1 - b.b) rho^2 - 2 a.b rho - a.a = 0
    const double square = 1 - b.lengthSqr(), half = a.dot(b), constant = a.lengthSqr();
    const double root = std::sqrt(std::max(0.0, half * half + square * constant));
    int count = 0;
    for (const double sign : {1.0, -1.0}) {
        const double rho = square != 0 ? (half + sign * root) / square : -constant / (2 * half);
        if (rho >= 0 && std::isfinite(rho)) centers[count++] = first.center + a + b * rho;
    }
    return count;
}

/// The smallest ball around a few, and which of them decide it.
struct Decision {
    RealBall ball;
    Few deciding;
};

/// The last of @a few is among those that decide.
Decision decide(const Few& few)
{
    const int others = few.count - 1;
    Decision best;
    best.ball.radius = std::numeric_limits<double>::infinity();
    const auto tryCenter = [&](const Vec3d& center, const Few& deciding) {
        double radius = 0;
        for (int i = 0; i < few.count; ++i) radius = std::max(radius, reach(center, few.balls[i]));
        if (radius < best.ball.radius) best = {{center, radius}, deciding};
    };
    for (int subset = 0; subset < 1 << others; ++subset) {
        Few some;
        some.add(few.balls[others]);
        for (int i = 0; i < others; ++i) {
            if (subset >> i & 1) some.add(few.balls[i]);
        }
        if (some.count > kMostDeciding) continue;
        if (some.count == 1) {
            tryCenter(some.balls[0].center, some);
            continue;
        }
        std::array<Vec3d, 2> centers;
        const int found = touchingCenters(some, centers);
        for (int i = 0; i < found; ++i) tryCenter(centers[i], some);
    }
    return best;
}

} // namespace

RealBall miniball(const std::vector<RealBall>& balls)
{
    const auto smaller = [](const RealBall& a, const RealBall& b) { return a.radius < b.radius; };
    const RealBall& largest = *std::max_element(balls.begin(), balls.end(), smaller);
    Decision present{largest, {}};
    present.deciding.add(largest);
    while (true) { // ends: the radius grows by a factor each time, and has a bound
        const RealBall* pivot = nullptr; // reaches farthest; of equals the first
        double most = -1;
        for (const RealBall& ball : balls) {
            const double here = reach(present.ball.center, ball);
            if (here <= most) continue;
            most = here;
            pivot = &ball;
        }
        if (most <= present.ball.radius * (1 + 1e-13)) return present.ball;
        Few few = present.deciding;
        few.add(*pivot);
        const Decision next = decide(few);
        if (!(next.ball.radius > present.ball.radius * (1 + 1e-13))) { // as far as doubles go
            present.ball.radius = most;
            return present.ball;
        }
        present = next;
    }
}

} // namespace openvdb_spheretree::detail
