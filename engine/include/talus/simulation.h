#pragma once
// The state that moves, as structures of arrays, and the step that moves it.
//
//   model --build--> Simulation: blocks | interfaces | contact points | wet patches
//
//   step:  drift            poses            <- velocities, forces of the last step
//          update patches   interfaces       <- poses (only when something moved far enough)
//          update contacts  contact point forces, interface wrenches <- poses
//          update water     wet wrenches     <- poses, gravity, level (only when one of them changed)
//          gather           block forces, velocities <- wrenches, in stored order
//
// See engine/README.md for what each stage reads and writes.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "talus/control.h"
#include "talus/frame.h"
#include "talus/model.h"
#include "talus/model_check.h"
#include "talus/result.h"
#include "talus/supports.h"
#include "talus/water_report.h"

namespace talus {

struct FailingState;  // talus/analysis.h

/// One watched block, at the end of a step.
struct BlockReport {
    std::string name;
    Vec3 position = Vec3::Zero();      ///< of the centroid [m]
    Vec3 velocity = Vec3::Zero();      ///< [m/s]
    Vec3 displacement = Vec3::Zero();  ///< of the centroid since the start [m]
    double rotation = 0;               ///< angle turned since the start [rad]
};

/// One record of a run's history.
struct HistoryRecord {
    double time = 0;  ///< [s]
    std::int64_t step = 0;
    double kinetic_energy = 0;  ///< [J]
    double elastic_energy = 0;  ///< stored in contacts and supports [J]
    double gravity_energy = 0;  ///< relative to the start [J]
    double out_of_balance = 0;  ///< largest out-of-balance force of a free block over its weight
    std::vector<BlockReport> watch;
    std::vector<Supports> supports;
    std::vector<WaterReport> waters{};          ///< closed volumes alone
    std::optional<Vec3> ground_acceleration{};  ///< where a recorded motion shakes the fixed blocks [m/s^2]
};

/// The state from which a time history started (`RunSettings::Start::equilibrium` takes the first that
/// exists).
enum class InitialState : std::uint8_t {
    equilibrium,  ///< in equilibrium under weight and water
    held,         ///< no equilibrium: that with unbreakable joints, released at time 0
    unstressed    ///< weight and water applied at once
};

struct RunResult {
    InitialState start = InitialState::unstressed;
    std::int64_t steps = 0;
    double simulated_seconds = 0;
    double time_step = 0;  ///< [s]
    std::size_t blocks = 0, interfaces = 0, contact_points = 0;
    double kinetic_energy = 0;  ///< [J]
    std::uint64_t state_hash = 0;
    double wall_seconds = 0;
    std::vector<BlockReport> watch;
    std::vector<Supports> supports;
    std::vector<WaterReport> waters{};  ///< closed volumes alone
    std::vector<Vec3> displacements;    ///< of each block's centroid since the start [m]
    bool interrupted = false;
    bool began = true;  ///< false: interrupted on the way to its start, and nothing was handed out
    std::vector<std::string> warnings;  ///< what left the valid range, if anything did
};

/// Callbacks of a run; every member may be left empty. All are called from the computing thread, in the order
/// of time: `begin` first; `record` and `light` at the start, at every frame interval and at the end; `full`
/// at the start, after every `frames_per_full`-th light frame and at the end (also of an interrupted run).
struct RunOutput {
    std::function<void(const RunGeometry&)> begin{};
    std::function<void(const HistoryRecord&)> record{};
    std::function<void(LightFrame&&)> light{};
    std::function<void(FullFrame&&)> full{};
    int frames_per_full = 10;
};

/// Time history of a model. With `resume`, a full frame of an earlier run of the same model, it continues
/// from there. It ends in the same bits as an uninterrupted run, on any number of threads. Frames up to that
/// one are not returned again. Errors: those of the model; a frame that does not fit it; a motion that became
/// infinite.
Result<RunResult> run(const Model& model, const Control& control, const RunOutput& output,
                      const FullFrame* resume = nullptr);

/// Time history of a failure that a search has found. It starts from the failing state with zero velocity at
/// time 0. It ends at `run.duration`, or at the first frame at which some block is displaced by `far_enough`
/// [m]. Poses, contacts, strengths and the shares of weight and water are the state's. Tilt and damping are
/// the model's, so give those at which it fails. Inertia is the true one, except for small blocks that would
/// set the time step (`FailingState::frequency`). Frames as of `run`; any full one resumes to the same bits
/// there. Errors: as of `run`.
Result<RunResult> runFailing(const Model& model, const Control& control, const RunOutput& output,
                             const FailingState& failing, double far_enough);

/// `run` for a history alone: `record` is called at the start, at every frame interval and at the end.
template <class Record>
requires std::is_invocable_v<const Record&, const HistoryRecord&> Result<RunResult> run(
    const Model& model, const Control& control, const Record& record) {
    return run(model, control, RunOutput{.record = record});
}

const char* toString(InitialState start);

/// Views of a simulation's arrays: valid as long as it lives, and changed by its steps.
struct BlockView {
    std::size_t size = 0;
    Vec3 origin = Vec3::Zero();               ///< of the positions, in the model frame [m]
    const double* position = nullptr;         ///< of centroids: x, y, z and one unused, block by block [m]
    const double* quaternion = nullptr;       ///< w, x, y, z: a block's own frame to the model frame
    std::array<const double*, 3> velocity{};  ///< x, y, z of the centroids, an array each [m/s]
};

/// A time history taken step by step, by the stages of `run`. In whole tens of steps it gives the same bits,
/// and it may continue beyond `run.duration`.
class Simulation {
 public:
    /// Builds the model and brings it to its start. Errors: those of the model; that it was stopped on the
    /// way.
    static Result<Simulation> begin(std::shared_ptr<const Model> model, const Control& control = {});
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();

    /// Steps more; fewer when it is stopped. Errors: a motion that became infinite.
    std::vector<Error> step(std::int64_t count, const Control& control = {});

    const Model& model() const;
    BlockView blocks() const;
    double time() const;  ///< [s]
    std::int64_t steps() const;
    double timeStep() const;  ///< of the next step [s]
    InitialState startedFrom() const;
    HistoryRecord record() const;  ///< time, steps, energies, out-of-balance force, watched blocks
    std::uint64_t stateHash() const;
    FullFrame frame() const;  ///< all of it, contact points too; not for `run`'s resume

 private:
    struct History;
    explicit Simulation(std::unique_ptr<History> history);
    std::unique_ptr<History> history_;
};

}  // namespace talus
