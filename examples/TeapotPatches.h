// SPDX-License-Identifier: Apache-2.0
/// @file TeapotPatches.h
/// @brief Control points of the Utah teapot: 32 bicubic Bezier patches.
///
/// Source: Martin Newell, University of Utah, 1975; public data. Later users added the bottom,
/// which his teapot had not, and made it lower; this is the form that copies in circulation share.
/// It spans x -3 to 3.43, y -2 to 2, z 0 to 3.15.
///
/// The teapot's symmetry is used to write it shortly, and makes patches meet exactly:
/// - rim, body, bottom and lid are profiles turned about z. A profile's point {radius, pull, z}
///   stands for the four control points (radius, 0), (radius, -pull), (pull, -radius), (0, -radius)
///   of a quarter turn. Six profiles, four quarters each: 24 patches.
/// - handle and spout are given for y <= 0, as rows across from one side of y = 0 to the other, and
///   mirrored. Four halves, two each: 8 patches.

#pragma once

#include <array>
#include <vector>

namespace teapot {

struct Point {
    double x, y, z;
};

/// Control points; neighbouring patches share a row, patch[0] or patch[3], or a row's end.
using Patch = std::array<std::array<Point, 4>, 4>;

struct ProfilePoint {
    double radius, pull, z;
};

constexpr ProfilePoint kProfile[6][4] = {
    // Rim, from inside out
    {{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4}},
    // Body, upper and lower half
    {{1.5, 0.84, 2.4}, {1.75, 0.98, 1.875}, {2, 1.12, 1.35}, {2, 1.12, 0.9}},
    {{2, 1.12, 0.9}, {2, 1.12, 0.45}, {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}},
    // Bottom, from outside in
    {{1.5, 0.84, 0.15}, {1.5, 0.84, 0.075}, {1.425, 0.798, 0}, {0, 0, 0}},
    // Lid, knob and plate
    {{0, 0, 3.15}, {0.8, 0.45, 3.15}, {0, 0, 2.85}, {0.2, 0.112, 2.7}},
    {{0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}},
};
constexpr double kHalf[4][4][4][3] = {
    // Handle, from the body's top down, in two pieces
    {{{-1.6, 0, 2.025}, {-1.6, -0.3, 2.025}, {-1.5, -0.3, 2.25}, {-1.5, 0, 2.25}},
        {{-2.3, 0, 2.025}, {-2.3, -0.3, 2.025}, {-2.5, -0.3, 2.25}, {-2.5, 0, 2.25}},
        {{-2.7, 0, 2.025}, {-2.7, -0.3, 2.025}, {-3, -0.3, 2.25}, {-3, 0, 2.25}},
        {{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8}}},
    {{{-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8}},
        {{-2.7, 0, 1.575}, {-2.7, -0.3, 1.575}, {-3, -0.3, 1.35}, {-3, 0, 1.35}},
        {{-2.5, 0, 1.125}, {-2.5, -0.3, 1.125}, {-2.65, -0.3, 0.9375}, {-2.65, 0, 0.9375}},
        {{-2, 0, 0.9}, {-2, -0.3, 0.9}, {-1.9, -0.3, 0.6}, {-1.9, 0, 0.6}}},
    // Spout, from the body to its mouth, in two pieces
    {{{1.7, 0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0, 0.6}},
        {{2.6, 0, 1.425}, {2.6, -0.66, 1.425}, {3.1, -0.66, 0.825}, {3.1, 0, 0.825}},
        {{2.3, 0, 2.1}, {2.3, -0.25, 2.1}, {2.4, -0.25, 2.025}, {2.4, 0, 2.025}},
        {{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}}},
    {{{2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4}},
        {{2.8, 0, 2.475}, {2.8, -0.25, 2.475}, {3.525, -0.25, 2.49375}, {3.525, 0, 2.49375}},
        {{2.9, 0, 2.475}, {2.9, -0.15, 2.475}, {3.45, -0.15, 2.5125}, {3.45, 0, 2.5125}},
        {{2.8, 0, 2.4}, {2.8, -0.15, 2.4}, {3.2, -0.15, 2.4}, {3.2, 0, 2.4}}},
};

/// @return the 32 patches, all showing the same side: profile p's quarter q is patch 4 p + q,
/// half h is patch 24 + 2 h, and its mirror image the one after it.
inline std::vector<Patch> patches()
{
    std::vector<Patch> all;
    for (const auto& profile : kProfile) {
        Patch patch;
        for (int i = 0; i < 4; ++i) {
            const auto [r, pull, z] = profile[i];
            patch[i] = {Point{r, 0, z}, Point{r, -pull, z}, Point{pull, -r, z}, Point{0, -r, z}};
        }
        for (int quarter = 0; quarter < 4; ++quarter) {
            all.push_back(patch);
            for (auto& row : patch) {
                for (Point& p : row) p = {p.y, -p.x, p.z};
            }
        }
    }
    for (const auto& half : kHalf) {
        Patch patch, mirrored;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                const double* p = half[i][j];
                patch[i][j] = {p[0], p[1], p[2]};
                mirrored[i][3 - j] = {p[0], -p[1], p[2]};
            }
        }
        all.push_back(patch);
        all.push_back(mirrored);
    }
    return all;
}

} // namespace teapot
