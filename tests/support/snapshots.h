#pragma once
// Small runs with snapshots, for tests.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "talus/formats/snapshot.h"
#include "talus/simulation.h"

namespace talus::test {

/// Two columns that slide and topple over a floor, with water between them that rises and runs out, and under
/// them.
inline std::string runScenarioText(const std::string& duration = "0.04") {
    return "[gravity]\ntilt_deg = 25.0\n[run]\nduration_s = " + duration +
           "\nframe_interval_s = 0.001\nwatch = [\"c1r1s1\"]\n[damping]\ncontact = 1e-5\n"
           "[material.rock]\ndensity = 2700.0\n"
           "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nfriction_deg = 15.0\n"
           "dilation_deg = 2.0\ncohesion = 500.0\ntensile_strength = 100.0\n"
           "[[stack]]\ncolumns = 2\nrows = 3\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
           "[[water]]\nfissure = 1\nlevels = [[0.0, 0.05], [0.03, 0.25]]\ndrains_at_aperture = 0.0005\n"
           "[[water]]\nbetween = [\"c2r1s1\", \"floor\"]\nhead = [0.1, 0.02]\n";
}

/// What a run handed out.
struct Recorded {
    RunGeometry geometry;
    std::vector<LightFrame> lights;
    std::vector<FullFrame> fulls;
    Result<RunResult> result = Error{"", "did not run"};
};

inline Recorded record(const Model& model, int frames_per_full = 10, const FullFrame* resume = nullptr,
                       const Control& control = {}) {
    Recorded all;
    RunOutput output;
    output.begin = [&](const RunGeometry& geometry) { all.geometry = geometry; };
    output.light = [&](LightFrame&& frame) { all.lights.push_back(std::move(frame)); };
    output.full = [&](FullFrame&& frame) { all.fulls.push_back(std::move(frame)); };
    output.frames_per_full = frames_per_full;
    all.result = run(model, control, output, resume);
    return all;
}

/// A whole snapshot file of a run.
inline std::vector<Error> writeFile(const std::string& path, const formats::Scenario& scenario,
                                    const Recorded& all, bool finish = true) {
    auto writer = formats::SnapshotWriter::open(path);
    if (!writer) return writer.errors();
    writer->write(formats::headerOf(scenario, all.geometry, "talus run", 10));
    std::size_t full = 0;
    for (const LightFrame& frame : all.lights) {
        writer->write(frame);
        if (full < all.fulls.size() && all.fulls[full].step == frame.step) writer->write(all.fulls[full++]);
    }
    if (!finish) return {};
    formats::SnapshotEnd end;
    end.ended = "finished";
    end.steps = all.result->steps;
    end.state_hash = all.result->state_hash;
    return writer->finish(end);
}

}  // namespace talus::test
