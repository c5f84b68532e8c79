#pragma once
// The one list of a message's fields: each pair is a field of a frame and its place in the message. Writing and reading
// both go through it.

#include <array>

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
void eachField(FrameBlocks& f, fb::BlocksT& m, const Move& move) {
    move(f.position, m.position);
    move(f.orientation, m.orientation);
    move(f.velocity, m.velocity);
    move(f.angular_momentum, m.angular_momentum);
    move(f.force, m.force);
    move(f.torque, m.torque);
    move(f.inverse_mass, m.inverse_mass);
    move(f.inverse_inertia, m.inverse_inertia);
}

template <class Move>
void eachField(FrameInterfaces& f, fb::InterfacesT& m, const Move& move) {
    move(f.block_a, m.block_a);
    move(f.block_b, m.block_b);
    move(f.face_a, m.face_a);
    move(f.face_b, m.face_b);
    move(f.joint, m.joint);
    move(f.area, m.area);
    move(f.origin_a, m.origin_a);
    move(f.e1_a, m.e1_a);
    move(f.e2_a, m.e2_a);
    move(f.origin_b, m.origin_b);
    move(f.e1_b, m.e1_b);
    move(f.e2_b, m.e2_b);
    move(f.reference_gap, m.reference_gap);
    move(f.point_begin, m.point_begin);
    move(f.patch_begin, m.patch_begin);
    move(f.patch_xi, m.patch_xi);
    move(f.patch_eta, m.patch_eta);
    move(f.force, m.force);
    move(f.moment_a, m.moment_a);
    move(f.moment_b, m.moment_b);
}

template <class Move>
void eachField(FramePoints& f, fb::PointsT& m, const Move& move) {
    move(f.xi, m.xi);
    move(f.eta, m.eta);
    move(f.area, m.area);
    move(f.offset_1, m.offset_1);
    move(f.offset_2, m.offset_2);
    move(f.bond, m.bond);
    move(f.dilation, m.dilation);
    move(f.normal, m.normal);
    move(f.shear_1, m.shear_1);
    move(f.shear_2, m.shear_2);
    move(f.water, m.water);
    move(f.state, m.state);
    move(f.mobilised, m.mobilised);
}

template <class Move>
void eachField(FrameWetPatches& f, fb::WetPatchesT& m, const Move& move) {
    move(f.block, m.block);
    move(f.water, m.water);
    move(f.water_begin, m.water_begin);
    move(f.interface, m.interface);
    move(f.origin, m.origin);
    move(f.e1, m.e1);
    move(f.e2, m.e2);
    move(f.vertex_begin, m.vertex_begin);
    move(f.vertex_x, m.vertex_x);
    move(f.vertex_y, m.vertex_y);
    move(f.head, m.head);
    move(f.force, m.force);
    move(f.moment, m.moment);
    move(f.computed_position, m.computed_position);
    move(f.computed_orientation, m.computed_orientation);
}

template <class Move>
void eachField(FrameWaters& f, fb::WaterLoadsT& m, const Move& move) {
    move(f.p0, m.p0);
    move(f.gradient, m.gradient);
    move(f.tilt, m.tilt);
    move(f.share, m.share);
    move(f.level, m.level);
    move(f.load_drained, m.load_drained);
    move(f.drained, m.drained);
}

// Where a joint's properties stand, as the scenario gives them and as the law takes them, in the order of kJointProperties.
inline constexpr std::array<std::vector<double> fb::JointsT::*, kJointPropertyCount> kJointMessages{
    &fb::JointsT::normal_stiffness,  &fb::JointsT::shear_stiffness,  &fb::JointsT::friction,
    &fb::JointsT::cohesion,          &fb::JointsT::tensile_strength, &fb::JointsT::residual_cohesion,
    &fb::JointsT::residual_friction, &fb::JointsT::dilation};
inline constexpr std::array<std::vector<double> fb::LawsT::*, kJointPropertyCount> kLawMessages{
    &fb::LawsT::normal_stiffness,      &fb::LawsT::shear_stiffness,
    &fb::LawsT::tan_friction,          &fb::LawsT::cohesion,
    &fb::LawsT::tensile_strength,      &fb::LawsT::residual_cohesion,
    &fb::LawsT::residual_tan_friction, &fb::LawsT::tan_dilation};

static_assert(kJointMessages.back() != nullptr && kLawMessages.back() != nullptr);

template <class Move>
void eachField(FrameLaws& f, fb::LawsT& m, const Move& move) {
    for (std::size_t p = 0; p < kJointPropertyCount; ++p) move(f.parameters[p], m.*kLawMessages[p]);
    move(f.bonded, m.bonded);
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
void eachField(FullFrame& f, fb::FullT& m, const Move& move) {
    move(f.time, m.time);
    move(f.step, m.step);
    move(f.state_hash, m.state_hash);
    eachField(f.blocks, move.into(m.blocks), move);
    eachField(f.interfaces, move.into(m.interfaces), move);
    eachField(f.points, move.into(m.points), move);
    eachField(f.wet, move.into(m.wet), move);
    eachField(f.waters, move.into(m.waters), move);
    eachField(f.laws, move.into(m.laws), move);
    eachField(f.loads, move.into(m.loads), move);
    move.into(m.search);
    move(f.search_position, m.search->position);
    move(f.search_orientation, m.search->orientation);
    move(f.search_margin, m.search->margin);
    eachField(f.progress, move.into(m.progress), move);
    move(f.shear_lost, m.shear_lost);
    move(f.warnings, m.warnings);
    move(f.origin_x, m.origin_x);
    move(f.origin_y, m.origin_y);
    move(f.origin_z, m.origin_z);
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
