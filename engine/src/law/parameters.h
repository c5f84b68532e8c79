#pragma once
// Parameters of the contact law for a joint, and the one list of them. Kernels, properties of joints
// (talus/joint.h) and frames all go through the list. A new parameter is a member, a line of the list, and
// its use in law.h.

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "simd/table.h"

namespace talus::contact {

/// V is a double, or one joint's numbers per lane of a register.
template <class V>
struct JointParameters {
    V normal_stiffness{};           ///< k_n [Pa/m]
    V shear_stiffness{};            ///< k_s [Pa/m]
    V tan_friction{};               ///< tan(phi), peak
    V cohesion{};                   ///< C [Pa]
    V tensile_strength{};           ///< sigma_t [Pa]
    V residual_tan_friction{};      ///< tan(phi_r)
    V residual_cohesion{};          ///< C_r [Pa]
    V tan_dilation{};               ///< tan(psi)
    V strength_factor{};            ///< for which the curve was made
    V softening{};                  ///< opening or slip over which the peak strength is lost [m]; 0: at once
    V residual_factor = V{} + 1.0;  ///< share of the curve's strength after the first slip
    V unloading_loss{};             ///< 1 - e^2: of the normal force while a contact point parts
    simd::MaskOf<V> bonded{};       ///< C > 0 or sigma_t > 0: opening breaks it for good
    simd::MaskOf<V> curved{};       ///< the strength is the curve's, not Coulomb's
    simd::TablesOf<V> curve{};      ///< shear strength over normal stress [Pa] (strength_curve.h)
};

/// A joint's law: its parameters, and the storage of its curve.
struct JointLaw : JointParameters<double> {
    std::shared_ptr<const std::vector<double>> table{};

    /// Null: Coulomb's line.
    void setCurve(std::shared_ptr<const std::vector<double>> of) {
        table = std::move(of);
        curved = table != nullptr;
        curve.at = curved ? table->data() : nullptr;
    }
};

template <class V>
struct LawParameter {
    const char* name;  ///< in frames, and in JointProperty::in_law
    V JointParameters<V>::*value;
};

/// All but those that follow from the others or from the joint alone.
template <class V>
inline constexpr std::array kLawParameters{
    LawParameter<V>{"normal_stiffness", &JointParameters<V>::normal_stiffness},
    LawParameter<V>{"shear_stiffness", &JointParameters<V>::shear_stiffness},
    LawParameter<V>{"tan_friction", &JointParameters<V>::tan_friction},
    LawParameter<V>{"cohesion", &JointParameters<V>::cohesion},
    LawParameter<V>{"tensile_strength", &JointParameters<V>::tensile_strength},
    LawParameter<V>{"residual_tan_friction", &JointParameters<V>::residual_tan_friction},
    LawParameter<V>{"residual_cohesion", &JointParameters<V>::residual_cohesion},
    LawParameter<V>{"tan_dilation", &JointParameters<V>::tan_dilation},
    LawParameter<V>{"strength_factor", &JointParameters<V>::strength_factor},
    LawParameter<V>{"softening_displacement", &JointParameters<V>::softening}};
inline constexpr std::size_t kLawParameterCount = kLawParameters<double>.size();

}  // namespace talus::contact
