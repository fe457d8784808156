// SPDX-License-Identifier: Apache-2.0
#include "BenchmarkJson.h"

#include <openvdb_spheretree/store/JsonWriter.h>

#include <tbb/info.h>

#include <ctime>
#include <fstream>

namespace spheretree_benchmark {

namespace {

using openvdb_spheretree::JsonWriter;

std::string processorModel()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return {};
}

void writeMachine(JsonWriter& json, const BenchmarkMachine& machine)
{
    json.beginObject("machine");
    json.value("date", machine.date);
    json.value("processor", machine.processor);
    json.value("threads", machine.threads);
    if (machine.load >= 0) {
        json.value("load", machine.load);
    } else {
        json.null("load");
    }
    json.endObject();
}

void writeTimes(JsonWriter& json, const Measurement& m)
{
    json.value("voxels", m.voxels);
    json.value("leaves", m.leaves);
    json.value("runs", m.runs);
    json.value("seconds", m.seconds);
    json.value("copy_seconds", m.copySeconds);
    json.value("mvoxels_per_second", m.megavoxelsPerSecond());
    json.value("of_copy", m.ofCopy());
    if (m.peakBytes) {
        json.value("peak_bytes", *m.peakBytes);
        json.value("peak_bytes_per_voxel", *m.peakBytesPerVoxel());
    } else {
        json.null("peak_bytes");
        json.null("peak_bytes_per_voxel");
    }
    if (m.balls > 0) json.value("balls", m.balls);
}

void writeMeasurement(JsonWriter& json, const Measurement& m)
{
    json.beginObject();
    json.value("object", m.object);
    if (!m.family.empty()) json.value("family", m.family);
    json.value("stage", m.stage);
    json.value("threads", m.threads);
    if (m.measured()) {
        writeTimes(json, m);
    } else {
        json.value("failure", m.failure);
    }
    json.endObject();
}

void writeGrowth(JsonWriter& json, const Growth& g)
{
    json.beginObject();
    json.value("family", g.family);
    json.value("stage", g.stage);
    json.value("threads", g.threads);
    json.value("exponent", g.exponent);
    json.value("sizes", g.sizes);
    json.value("smallest_voxels", g.smallestVoxels);
    json.value("largest_voxels", g.largestVoxels);
    json.endObject();
}

} // namespace

BenchmarkMachine thisMachine()
{
    BenchmarkMachine machine;
    const std::time_t now = std::time(nullptr);
    char date[32];
    std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    machine.date = date;
    machine.processor = processorModel();
    machine.threads = tbb::info::default_concurrency();
    std::ifstream load("/proc/loadavg");
    if (!(load >> machine.load)) machine.load = -1;
    return machine;
}

std::string benchmarkJson(const BenchmarkMachine& machine,
    const std::vector<Measurement>& measurements, const std::vector<Growth>& growths)
{
    JsonWriter json;
    json.beginObject();
    writeMachine(json, machine);
    json.beginArray("measurements");
    for (const Measurement& m : measurements) writeMeasurement(json, m);
    json.endArray();
    json.beginArray("growth");
    for (const Growth& g : growths) writeGrowth(json, g);
    json.endArray();
    json.endObject();
    return json.text() + "\n";
}

} // namespace spheretree_benchmark
