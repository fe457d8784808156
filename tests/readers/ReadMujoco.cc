// SPDX-License-Identifier: Apache-2.0
// Loads a robot with MuJoCo, and prints its spheres (x y z radius, in the frame of their body) and of its last body the
// mass, the moments of inertia, the center of mass and the inertia about it: xx yy zz xy xz yz, along the body's axes.

#include <mujoco/mujoco.h>

#include <cstdio>

int main(int count, char** arguments)
{
    if (count != 2) return 2;
    char error[1000] = "";
    mjModel* const model = mj_loadXML(arguments[1], nullptr, error, sizeof(error));
    if (!model) {
        std::fprintf(stderr, "%s\n", error);
        return 1;
    }
    for (int i = 0; i < model->ngeom; ++i) {
        if (model->geom_type[i] != mjGEOM_SPHERE) continue;
        const mjtNum* const at = model->geom_pos + 3 * i;
        std::printf(
            "sphere %.17g %.17g %.17g %.17g\n", at[0], at[1], at[2], model->geom_size[3 * i]);
    }
    const int body = model->nbody - 1;
    const mjtNum* const inertia = model->body_inertia + 3 * body;
    std::printf("mass %.17g", model->body_mass[body]);
    for (int i = 0; i < 3; ++i) std::printf(" %.17g", inertia[i]);
    for (int i = 0; i < 3; ++i) std::printf(" %.17g", model->body_ipos[3 * body + i]);
    mjtNum axes[9]; // its columns are the principal axes
    mju_quat2Mat(axes, model->body_iquat + 4 * body);
    const int entries[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (const auto& entry : entries) {
        mjtNum sum = 0;
        for (int i = 0; i < 3; ++i)
            sum += axes[3 * entry[0] + i] * inertia[i] * axes[3 * entry[1] + i];
        std::printf(" %.17g", sum);
    }
    std::printf("\n");
    mj_deleteModel(model);
    return 0;
}
