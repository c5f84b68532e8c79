#pragma once
// Fields of messages beside the arrays of a full frame (tables.h): each pair is a field and its place in the
// message. Writing and reading both go through it.

#include <array>
#include <string_view>
#include <vector>

#include "snapshot_generated.h"
#include "talus/formats/snapshot.h"
#include "talus/frame.h"

namespace talus::formats {

namespace fb = talus::snapshot;

template <class Move>
void eachField(LightFrame& f, fb::FrameT& m, const Move& move) {
    move(f.time, m.time);
    move(f.step, m.step);
    move(f.state_hash, m.state_hash);
    move(f.tilt, m.tilt);
    move(f.time_step, m.time_step);
    move.into(m.energies);
    move(f.kinetic_energy, m.energies->kinetic);
    move(f.elastic_energy, m.energies->elastic);
    move(f.gravity_energy, m.energies->gravity);
    move(f.out_of_balance, m.out_of_balance);
    move(f.displacement, m.displacement);
    move(f.rotation, m.rotation);
    move(f.velocity, m.velocity);
    move.into(m.water);
    move(f.water.level, m.water->level);
    move(f.water.table, m.water->table);
    move(f.water.drained, m.water->drained);
}

template <class Move>
void eachField(SupportLines& f, fb::SupportLinesT& m, const Move& move) {
    move(f.name, m.name);
    move(f.point_begin, m.point_begin);
    move(f.point, m.point);
    move(f.block, m.block);
}

template <class Move>
void eachField(SnapshotFlow& f, fb::FlowPressureT& m, const Move& move) {
    move(f.node, m.node);
    move(f.pressure, m.pressure);
    move(f.triangle, m.triangle);
    move(f.joint, m.joint);
    move(f.block_a, m.block_a);
    move(f.block_b, m.block_b);
}

template <class Move>
void eachField(SupportForces& f, fb::SupportForcesT& m, const Move& move) {
    move(f.force, m.force);
    move(f.utilisation, m.utilisation);
    move(f.broken, m.broken);
}

// Columns of the first version: of a joint's properties by their keys, of the law's parameters by their
// names. Everything that has none goes by its name (JointsT::property, LawsT::parameter), so that nothing
// here changes with a new property.
struct JointColumn {
    std::string_view key;
    std::vector<double> fb::JointsT::*values;
};
inline constexpr std::array kJointColumns{
    JointColumn{"normal_stiffness", &fb::JointsT::normal_stiffness},
    JointColumn{"shear_stiffness", &fb::JointsT::shear_stiffness},
    JointColumn{"friction_deg", &fb::JointsT::friction},
    JointColumn{"cohesion", &fb::JointsT::cohesion},
    JointColumn{"tensile_strength", &fb::JointsT::tensile_strength},
    JointColumn{"residual_friction_deg", &fb::JointsT::residual_friction},
    JointColumn{"residual_cohesion", &fb::JointsT::residual_cohesion},
    JointColumn{"dilation_deg", &fb::JointsT::dilation}};

struct LawColumn {
    std::string_view name;
    std::vector<double> fb::LawsT::*values;
};
inline constexpr std::array kLawColumns{LawColumn{"normal_stiffness", &fb::LawsT::normal_stiffness},
                                        LawColumn{"shear_stiffness", &fb::LawsT::shear_stiffness},
                                        LawColumn{"tan_friction", &fb::LawsT::tan_friction},
                                        LawColumn{"cohesion", &fb::LawsT::cohesion},
                                        LawColumn{"tensile_strength", &fb::LawsT::tensile_strength},
                                        LawColumn{"residual_tan_friction", &fb::LawsT::residual_tan_friction},
                                        LawColumn{"residual_cohesion", &fb::LawsT::residual_cohesion},
                                        LawColumn{"tan_dilation", &fb::LawsT::tan_dilation}};

template <class Move>
void eachField(FrameLaws& f, fb::LawsT& m, const Move& move) {
    move.laws(f, m);
}

template <class Move>
void eachField(FrameLoads& f, fb::LoadsT& m, const Move& move) {
    move(f.tilt, m.tilt);
    move(f.gravity_share, m.gravity_share);
    move(f.water_share, m.water_share);
    move(f.time, m.time);
    move(f.mass_damping, m.mass_damping);
    move(f.rotation_damping, m.rotation_damping);
    move(f.contact_damping, m.contact_damping);
    move(f.local_damping, m.local_damping);
    move(f.release, m.release);
}

template <class Move>
void eachField(RunProgress& f, fb::ProgressT& m, const Move& move) {
    move(f.time_step, m.time_step);
    move(f.stability_bound, m.stability_bound);
    move(f.step_safety, m.step_safety);
    move(f.next_frame, m.next_frame);
    move(f.frames, m.frames);
    move(f.warned_of_step, m.warned_of_step);
}

template <class Move>
void eachField(RunGeometry& f, fb::GeometryT& m, const Move& move) {
    move(f.mass, m.mass);
    move(f.centroid, m.centroid);
    move(f.orientation, m.orientation);
    move(f.size, m.size);
    move(f.vertex_begin, m.vertex_begin);
    move(f.vertex, m.vertex);
    move(f.face_begin, m.face_begin);
    move(f.face_vertex_begin, m.face_vertex_begin);
    move(f.face_vertex, m.face_vertex);
    move(f.face_joint, m.face_joint);
    move(f.face_part, m.face_part);
    move(f.face_inner, m.face_inner);
}

template <class Move>
void eachField(SnapshotHeader& f, fb::HeaderT& m, const Move& move) {
    move(f.format, m.format);
    move(f.scenario_path, m.scenario_path);
    move(f.scenario_text, m.scenario_text);
    move(f.units, m.units);
    move.into(m.build);
    move(f.build.version, m.build->version);
    move(f.build.git_hash, m.build->git_hash);
    move(f.build.compiler, m.build->compiler);
    move(f.build.instruction_set, m.build->instruction_set);
    move(f.build.build_type, m.build->build_type);
    move(f.command_line, m.build->command_line);
    move(f.gravity, m.gravity);
    move(f.duration, m.duration);
    move(f.frame_interval, m.frame_interval);
    move(f.frames_per_full, m.frames_per_full);
    eachField(f.geometry, move.into(m.geometry), move);
    move(f.names, m.geometry->name);
    move(f.motions, m.geometry->motion);
}

}  // namespace talus::formats
