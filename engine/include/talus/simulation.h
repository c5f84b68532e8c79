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

#include "talus/analysis.h"
#include "talus/frame.h"
#include "talus/model.h"
#include "talus/result.h"
#include "talus/supports.h"

namespace talus {

/// One watched block, at the end of a step.
struct BlockReport {
    std::string name;
    Vec3 position = Vec3::Zero();      ///< of the centroid [m]
    Vec3 velocity = Vec3::Zero();      ///< [m/s]
    Vec3 displacement = Vec3::Zero();  ///< of the centroid since the start [m]
    double rotation = 0;               ///< angle turned since the start [rad]
};

/// A water whose level follows from its volume (Water::closed), at the end of a step.
struct WaterReport {
    std::string name;     ///< as messages call it: "water[0]"
    double level = 0;     ///< depth or elevation, as the scenario gives it [m]
    double volume = 0;    ///< [m^3]
    double run_over = 0;  ///< in all, above its overflow [m^3]
    double leaked = 0;    ///< in all, through its foot [m^3]
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
    std::optional<Vec3> ground_acceleration{};  ///< where a record moves the fixed blocks [m/s^2]
};

/// What a time history started from (`RunSettings::Start::equilibrium` takes the first that exists).
enum class InitialState : std::uint8_t {
    equilibrium,  ///< at rest under weight and water
    held,         ///< no equilibrium: at rest with joints that do not give way, let go at time 0
    unstressed    ///< weight and water came all at once
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

/// What a run hands out while it goes on; every member may be left empty. All are called from the computing
/// thread, in the order of time: `begin` first, `record` and `light` at the start, at every frame interval
/// and at the end, `full` behind every `frames_per_full`-th light frame and at the start and the end (also of
/// an interrupted run).
struct RunOutput {
    std::function<void(const RunGeometry&)> begin{};
    std::function<void(const HistoryRecord&)> record{};
    std::function<void(LightFrame&&)> light{};
    std::function<void(FullFrame&&)> full{};
    int frames_per_full = 10;
};

/// Time history of a model. With `resume`, a full frame of an earlier run of the same model, it goes on from
/// there and ends in the same bits as a run never interrupted, on any number of threads; frames up to that
/// one are not handed out again. Errors: those of the model; a frame that does not fit it; a motion that
/// became infinite.
Result<RunResult> run(const Model& model, const Control& control, const RunOutput& output,
                      const FullFrame* resume = nullptr);

/// Time history of a failure that a search has found: from the state in which it has left its place, at rest
/// at time 0, to `run.duration`, or to the first frame at which some block is displaced by `far_enough` [m].
/// Poses, contacts, strengths and the shares of weight and water are the state's; tilt and damping are the
/// model's, so they should be those it fails at. Inertia is the true one, but for small blocks that would set
/// the time step (`FailingState::frequency`). Frames as of `run`; any full one resumes to the same bits
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

/// Blocks of a simulation where they lie: valid as long as it lives, and changed by its steps.
struct BlockView {
    std::size_t size = 0;
    Vec3 origin = Vec3::Zero();               ///< of the positions, in the model frame [m]
    const double* position = nullptr;         ///< of centroids: x, y, z and one unused, block by block [m]
    const double* quaternion = nullptr;       ///< w, x, y, z: a block's own frame to the model frame
    std::array<const double*, 3> velocity{};  ///< x, y, z of the centroids, an array each [m/s]
};

/// A time history that is taken step by step, by the stages of `run`: in whole tens of steps it passes
/// through the same bits, and it goes on behind `run.duration`.
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

/// What a model looks like to the engine, before anything moves.
struct ModelCheck {
    std::vector<std::string> warnings;  ///< what is allowed but hardly meant
    std::size_t interfaces = 0;         ///< of faces, edges or vertices that touch
    std::size_t contact_points = 0;     ///< of these
    std::size_t idle_interfaces = 0;  ///< kept ready where vertices and edges may meet before the next search
};

/// Checks what needs geometry: blocks that overlap, water on faces that are not there, pairs that do not
/// touch. Empty when the model can be built. \param found  if given, takes what was found on the way
std::vector<Error> checkModel(const Model& model, const Control& control = {}, ModelCheck* found = nullptr);

/// Two blocks that share at least one interface at the start, and the joint between them.
struct TouchingPair {
    std::int32_t block_a = 0, block_b = 0;  ///< a < b
    std::int32_t joint = 0;                 ///< of the first interface they share
};

/// All pairs that touch, in the order of their blocks. Errors: as of checkModel.
Result<std::vector<TouchingPair>> touchingPairs(const Model& model);

}  // namespace talus
