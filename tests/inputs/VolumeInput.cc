// SPDX-License-Identifier: Apache-2.0
#include "VolumeInput.h"

#include "SampleBytes.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace spheretree_test {

using openvdb_spheretree::NumberType;
using openvdb_spheretree::VolumeSettings;

namespace {

constexpr std::size_t kSettings = 16; // bytes
constexpr std::size_t kMostParts = 12;

std::vector<std::string> partsOf(const std::string& bytes)
{
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (parts.size() + 1 < kMostParts) {
        const std::size_t end = bytes.find(kPartEnd, begin);
        if (end == bytes.npos) break;
        parts.push_back(bytes.substr(begin, end - begin));
        begin = end + std::strlen(kPartEnd);
    }
    parts.push_back(bytes.substr(begin));
    return parts;
}

template <typename Value>
Value numberAt(const std::string& bytes, std::size_t place)
{
    Value value;
    std::memcpy(&value, bytes.data() + place, sizeof(value));
    return value;
}

VolumeSettings settingsOf(const std::string& head)
{
    VolumeSettings settings;
    settings.shape.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        (*settings.shape)[axis] = numberAt<uint32_t>(head, 4 * axis);
    }
    constexpr auto kTypes = unsigned(NumberType::Float64) + 1;
    settings.type = NumberType(uint8_t(head[12]) % kTypes);
    settings.bigEndian = head[13] % 2;
    settings.headerBytes = numberAt<uint16_t>(head, 14);
    return settings;
}

} // namespace

bool VolumeInput::isKind(const std::string& extension)
{
    return extension == ".raw" || extension == ".detached" || extension == ".stack";
}

void VolumeInput::set(const std::string& bytes)
{
    if (mKind == ".raw") {
        std::string head = bytes.substr(0, kSettings);
        head.resize(kSettings);
        mSettings = settingsOf(head);
        mPath = mRead = mFolder.set("input.raw", bytes.substr(std::min(bytes.size(), kSettings)));
        return;
    }
    const std::vector<std::string> parts = partsOf(bytes);
    if (mKind == ".detached") {
        mPath = mRead = mFolder.set("input.nhdr", parts.front());
        mFolder.set("input.raw", parts.size() > 1 ? parts[1] : std::string());
        return;
    }
    const std::string extension = parts.front().rfind('P', 0) == 0 ? ".pgm" : ".png";
    mFolder.clear();
    mPath = mFolder.path() + "/slice_"; // a message names the slice, or the stack
    mRead = mPath + "%d" + extension;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        mFolder.set("slice_" + std::to_string(i) + extension, parts[i]);
    }
}

void VolumeInput::read() const { openvdb_spheretree::readVolumeFile(mRead, mSettings); }

std::string rawInput(const VolumeSettings& settings, const std::string& numbers)
{
    std::string bytes;
    for (const uint64_t side : settings.shape.value()) bytes += bytesOf(uint32_t(side));
    bytes += bytesOf(uint8_t(settings.type.value()));
    bytes += bytesOf(uint8_t(settings.bigEndian));
    bytes += bytesOf(uint16_t(settings.headerBytes));
    return bytes + numbers;
}

} // namespace spheretree_test
