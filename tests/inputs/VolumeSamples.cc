// SPDX-License-Identifier: Apache-2.0
/// @file VolumeSamples.cc
/// @brief Samples of volumes and pictures of other tools, byte by byte.

#include "SampleBytes.h"
#include "SampleFiles.h"
#include "VolumeInput.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>

namespace spheretree_test {

namespace {

/// 9 x 5 x 10 numbers: two slabs of leaves, leaves that are not full, and one that is all the same.
template <typename Value>
std::string numbers(bool swapped = false)
{
    std::string bytes;
    for (int i = 0; i < 9 * 5 * 10; ++i) bytes += bytesOf(Value(i % 7 == 0 ? 0 : i % 100), swapped);
    return bytes;
}

std::string raw()
{
    openvdb_spheretree::VolumeSettings settings;
    settings.shape = {9, 5, 10};
    settings.type = openvdb_spheretree::NumberType::UInt16;
    settings.headerBytes = 6;
    return rawInput(settings, "header" + numbers<uint16_t>());
}

std::string npyOf(const std::string& dictionary, const std::string& values)
{
    std::string header = dictionary;
    header.resize((10 + header.size()) / 16 * 16 + 5, ' ');
    header += '\n';
    return "\x93NUMPY" + std::string("\x01\x00", 2) + bytesOf(uint16_t(header.size())) + header
        + values;
}

std::string npyInt()
{
    return npyOf(
        "{'descr': '<i2', 'fortran_order': True, 'shape': (9, 5, 10), }", numbers<int16_t>());
}

std::string npyFloat()
{
    return npyOf(
        "{'descr': '>f4', 'fortran_order': False, 'shape': (10, 5, 9), }", numbers<float>(true));
}

std::string nrrdOf(const std::string& encoding, const std::string& values)
{
    return "NRRD0004\n# a comment\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
           "sizes: 9 5 10\nspace directions: (0.5,0,0) (0,0.5,0) (0,0,1)\nkinds: domain domain "
           "domain\n"
           "endian: little\nencoding: "
        + encoding + "\nspace origin: (1,2,-3)\nkey:=value\n\n" + values;
}

std::string nrrdRaw() { return nrrdOf("raw", numbers<int16_t>()); }
std::string nrrdGzip() { return nrrdOf("gzip", deflated(numbers<int16_t>(), Deflated::Gzip)); }

std::string nrrdText()
{
    std::string values;
    for (int i = 0; i < 9 * 5 * 10; ++i)
        values += std::to_string(i % 7) + (i % 9 == 8 ? "\n" : " ");
    return nrrdOf("text", values);
}

template <typename Value>
void put(std::string& header, std::size_t place, Value value)
{
    const std::string bytes = bytesOf(value);
    header.replace(place, bytes.size(), bytes);
}

/// @param code  0: sizes of voxels alone; 1: a quaternion; 2: a matrix
std::string niiOf(int code)
{
    std::string header(352, '\0');
    put(header, 0, int32_t(348));
    const int16_t dim[] = {3, 9, 5, 10, 1, 1, 1, 1};
    for (std::size_t i = 0; i < 8; ++i) put(header, 40 + 2 * i, dim[i]);
    put(header, 70, int16_t(4)); // int16
    put(header, 72, int16_t(16));
    for (std::size_t i = 0; i < 4; ++i) put(header, 76 + 4 * i, 1.f + 0.5f * float(i));
    put(header, 108, 352.f);
    put(header, 112, code == 2 ? 0.5f : 0.f);
    put(header, 252, int16_t(code == 1));
    put(header, 254, int16_t(code == 2));
    put(header, 256, 0.6f);
    for (std::size_t i = 0; i < 3; ++i) put(header, 280 + 20 * i, 2.f);
    header.replace(344, 3, "n+1");
    return header + numbers<int16_t>();
}

std::string niiSizes() { return niiOf(0); }
std::string niiQuaternion() { return niiOf(1); }
std::string niiMatrix() { return niiOf(2); }
std::string niiGzip() { return deflated(niiOf(2), Deflated::Gzip); }

std::string detached()
{
    return "NRRD0004\ntype: short\ndimension: 3\nsizes: 9 5 10\nendian: little\nencoding: raw\n"
           "byte skip: 4\ndata file: input.raw"
        + std::string(kPartEnd) + "skip" + numbers<int16_t>();
}

// Pictures of 13 x 6 pixels

std::string chunk(const std::string& name, const std::string& bytes)
{
    const std::string body = name + bytes;
    const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
    return bytesOf(uint32_t(bytes.size()), true) + body + bytesOf(uint32_t(crc), true);
}

/// @param rowBytes  of a row, without the byte that says its filter
std::string pngOf(char bits, char type, std::size_t rowBytes, const std::string& more)
{
    std::string rows;
    for (std::size_t y = 0; y < 6; ++y) rows += '\0' + std::string(rowBytes, char(16 * y));
    return "\x89PNG\r\n\x1a\n"
        + chunk("IHDR",
            bytesOf(uint32_t(13), true) + bytesOf(uint32_t(6), true) + bits + type
                + std::string(3, '\0'))
        + more + chunk("IDAT", deflated(rows, Deflated::Zlib)) + chunk("IEND", "");
}

std::string pngGray() { return pngOf(8, 0, 13, chunk("gAMA", bytesOf(uint32_t(45455), true))); }
std::string pngWide() { return pngOf(16, 0, 26, ""); }
std::string pngColor() { return pngOf(8, 2, 39, ""); }
std::string pngPalette()
{
    return pngOf(4, 3, 7, chunk("PLTE", std::string("\1\1\1\2\2\2\3\3\3\4\4\4\5\5\5\6\6\6", 18)));
}

std::string pgmBytes() { return "P5\n# a comment\n13 6\n255\n" + std::string(78, '\7'); }
std::string pgmWide() { return "P5 13 6 999\n" + std::string(156, '\1'); }

std::string pgmText()
{
    std::string text = "P2\n13 6 # wide, high\n300\n";
    for (int i = 0; i < 78; ++i) text += std::to_string(4 * i % 301) + (i % 13 == 12 ? "\n" : " ");
    return text;
}

std::string stackOf(const std::string& slice)
{
    return slice + kPartEnd + slice + kPartEnd + slice;
}

std::string stackPgm() { return stackOf(pgmWide()); }
std::string stackPng() { return stackOf(pngGray()); }

} // namespace

const std::vector<SampleMaker>& volumeSamples()
{
    static const std::vector<SampleMaker> samples = {
        {"raw", ".raw", raw},
        {"npy_int", ".npy", npyInt},
        {"npy_float", ".npy", npyFloat},
        {"nrrd_raw", ".nrrd", nrrdRaw},
        {"nrrd_gzip", ".nrrd", nrrdGzip},
        {"nrrd_text", ".nrrd", nrrdText, false},
        {"nii_sizes", ".nii", niiSizes},
        {"nii_quaternion", ".nii", niiQuaternion},
        {"nii_matrix", ".nii", niiMatrix},
        {"nii_gzip", ".nii.gz", niiGzip},
        {"png_gray", ".png", pngGray},
        {"png_wide", ".png", pngWide},
        {"png_color", ".png", pngColor},
        {"png_palette", ".png", pngPalette},
        {"pgm_bytes", ".pgm", pgmBytes},
        {"pgm_wide", ".pgm", pgmWide},
        {"pgm_text", ".pgm", pgmText, false},
        {"detached", ".detached", detached},
        {"stack_pgm", ".stack", stackPgm, false},
        {"stack_png", ".stack", stackPng, false},
    };
    return samples;
}

} // namespace spheretree_test
