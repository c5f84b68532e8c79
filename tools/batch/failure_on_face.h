#pragma once
// Where on a face the blocks of one failure lie. Pure geometry.

#include <cstddef>
#include <vector>

#include "batch/face_cells.h"
#include "talus/model.h"

namespace talus::tools::batch {

/// One failure as the face shows it.
struct FailureOnFace {
    struct Share {
        std::size_t cell = 0;
        double volume_per_area = 0;  ///< of what fails, per m2 of the face [m]
    };
    std::vector<Share> cells;  ///< that lie on a failing block, ascending; each once
    double volume = 0;         ///< of all that fails [m^3]
    double hidden_volume = 0;  ///< of it, where no cell lies on any of the blocks [m^3]
};

/// Finds cells by place.
class FaceIndex {
 public:
    explicit FaceIndex(const Face& face);

    /// A cell counts when its centre lies on a face of a failing block. A block's volume is shared over its
    /// cells by their area. That of blocks without a cell, behind others or smaller than a cell, is shared
    /// over all cells of the failure: the sum over cells of volume per area times area, plus the hidden
    /// volume, is the volume.
    FailureOnFace failureOf(const Model& model, const std::vector<std::size_t>& failing) const;

 private:
    void addCellsOn(const Polyhedron& shape, std::size_t face, std::vector<std::size_t>& cells) const;

    const Face& face_;
    std::vector<std::size_t> by_x_;  ///< cells by the x of their centres
    double tolerance_ = 0;           ///< how far a centre lies off a block's face [m]
};

}  // namespace talus::tools::batch
