// SPDX-License-Identifier: Apache-2.0
#include "TreeSettings.h"

namespace spheretree_test {

void setType(openvdb_spheretree::SphereTreeSettings& settings, openvdb_spheretree::TreeType type)
{
    using namespace openvdb_spheretree;
    const auto* shared = settings.find<PyramidOptions>();
    const PyramidOptions pyramid = shared ? *shared : PyramidOptions();
    if (settings.type() == type) return;
    if (type == TreeType::Tight) settings.kind = TightOptions();
    else if (type == TreeType::Extended) settings.kind = ExtendedOptions();
    else settings.kind = ReversibleOptions();
    if (type != TreeType::Tight) settings.pyramid() = pyramid;
}

} // namespace spheretree_test
