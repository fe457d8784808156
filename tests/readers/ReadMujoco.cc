// SPDX-License-Identifier: Apache-2.0
// Loads a robot with MuJoCo, and prints its spheres (x y z radius, in the frame of their body) and the mass and
// moments of inertia of its last body.

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
    std::printf("mass %.17g %.17g %.17g %.17g\n", model->body_mass[body], inertia[0], inertia[1],
        inertia[2]);
    mj_deleteModel(model);
    return 0;
}
