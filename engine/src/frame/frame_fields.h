#pragma once
// The one list of what a full frame holds: each pair is an array of the state and its place in the frame.
// Writing and reading a frame both use it, so they cannot differ. An array added to arrays.h that does not
// follow from others belongs here, in talus/frame.h, in talus/frame_table.h and in formats/snapshot.fbs.

#include "state/arrays.h"
#include "talus/frame.h"

namespace talus {

/// Calls pair(array of the state, array of the frame); one of the two is const.
template <class Blocks, class FrameBlocks, class Pair>
void eachBlockField(Blocks& s, FrameBlocks& f, const Pair& pair) {
    pair(s.position, f.position);
    pair(s.orientation, f.orientation);
    pair(s.velocity, f.velocity);
    pair(s.angular_momentum, f.angular_momentum);
    pair(s.force, f.force);
    pair(s.torque, f.torque);
    pair(s.inverse_mass, f.inverse_mass);
    pair(s.inverse_inertia, f.inverse_inertia);
}

template <class Interfaces, class FrameInterfaces, class Pair>
void eachInterfaceField(Interfaces& s, FrameInterfaces& f, const Pair& pair) {
    pair(s.block_a, f.block_a);
    pair(s.block_b, f.block_b);
    pair(s.face_a, f.face_a);
    pair(s.face_b, f.face_b);
    pair(s.joint, f.joint);
    pair(s.area, f.area);
}

/// What lies slot by slot in the state: calls each(member of InterfaceFrame, array of the frame).
template <class FrameInterfaces, class Each>
void eachFrameVector(FrameInterfaces& f, const Each& each) {
    each(&InterfaceFrame::origin_a, f.origin_a);
    each(&InterfaceFrame::e1_a, f.e1_a);
    each(&InterfaceFrame::e2_a, f.e2_a);
    each(&InterfaceFrame::origin_b, f.origin_b);
    each(&InterfaceFrame::e1_b, f.e1_b);
    each(&InterfaceFrame::e2_b, f.e2_b);
    each(&InterfaceFrame::reference_gap, f.reference_gap);
}

/// Likewise of InterfaceWrench.
template <class FrameInterfaces, class Each>
void eachWrenchVector(FrameInterfaces& f, const Each& each) {
    each(&InterfaceWrench::force, f.force);
    each(&InterfaceWrench::moment_a, f.moment_a);
    each(&InterfaceWrench::moment_b, f.moment_b);
}

template <class Wet, class FrameWet, class Pair>
void eachWetField(Wet& s, FrameWet& f, const Pair& pair) {
    pair(s.block, f.block);
    pair(s.water, f.water);
    pair(s.water_begin, f.water_begin);
    pair(s.interface, f.interface);
    pair(s.origin, f.origin);
    pair(s.e1, f.e1);
    pair(s.e2, f.e2);
    pair(s.vertex_begin, f.vertex_begin);
    pair(s.vertex_x, f.vertex_x);
    pair(s.vertex_y, f.vertex_y);
    pair(s.head, f.head);
    pair(s.force, f.force);
    pair(s.moment, f.moment);
    pair(s.computed_position, f.computed_position);
    pair(s.computed_orientation, f.computed_orientation);
}

template <class State, class FullFrame, class Pair>
void eachScalar(State& s, FullFrame& f, const Pair& pair) {
    pair(s.time, f.time);
    pair(s.step, f.step);
    pair(s.load.tilt, f.loads.tilt);
    pair(s.load.gravity_share, f.loads.gravity_share);
    pair(s.load.water_share, f.loads.water_share);
    pair(s.load.time, f.loads.time);
    pair(s.damping.mass, f.loads.mass_damping);
    pair(s.damping.rotation, f.loads.rotation_damping);
    pair(s.damping.contact, f.loads.contact_damping);
    pair(s.damping.local, f.loads.local_damping);
    pair(s.release, f.loads.release);
    pair(s.search_margin, f.search_margin);
    pair(s.shear_lost, f.shear_lost);
}

/// All but the arrays whose layout differs: those per water, per joint, per corner and per contact point.
template <class State, class FullFrame, class Pair>
void eachField(State& s, FullFrame& f, const Pair& pair) {
    eachBlockField(s.blocks, f.blocks, pair);
    eachInterfaceField(s.interfaces, f.interfaces, pair);
    eachWetField(s.wet, f.wet, pair);
    eachScalar(s, f, pair);
    pair(s.drained, f.waters.drained);
    pair(s.search_position, f.search_position);
    pair(s.search_orientation, f.search_orientation);
    pair(s.warnings, f.warnings);
}

}  // namespace talus
