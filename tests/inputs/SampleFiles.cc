// SPDX-License-Identifier: Apache-2.0
#include "SampleFiles.h"

#include <stdexcept>

namespace spheretree_test {

namespace {

std::vector<SampleMaker> allSamples()
{
    std::vector<SampleMaker> all;
    for (const auto* part :
        {&textSamples(), &sceneSamples(), &volumeSamples(), &treeSamples(), &gridSamples()}) {
        all.insert(all.end(), part->begin(), part->end());
    }
    return all;
}

} // namespace

std::vector<std::string> sampleNames()
{
    std::vector<std::string> names;
    for (const SampleMaker& sample : allSamples()) names.push_back(sample.name);
    return names;
}

SampleFile sampleFile(const std::string& name)
{
    for (const SampleMaker& sample : allSamples()) {
        if (sample.name != name) continue;
        return {sample.name, sample.extension, sample.saysItsLength, sample.make(), sample.mutants};
    }
    throw std::invalid_argument("there is no sample named " + name);
}

} // namespace spheretree_test
