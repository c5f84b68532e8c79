"""The map of failure of a batch, as numpy arrays."""

import json

import numpy


class FailureMap:
    """Probability of failure over the face of a slope. Arrays have an entry for each of the n cells, in the model frame.

    - centres, normals (n, 3) [m, 1]: a point of each cell; the unit normal out of the rock
    - areas (n,) [m^2]
    - hits (n,): samples in which the cell lies on what fails
    - probability (n,): their share of ``runs``
    - probability_low, probability_high (n,): its confidence interval, by Clopper and Pearson
    - volume_per_area (n,) [m^3 per m^2]: expected failing volume, the mean over all samples
    - corners (m, 3) [m], polygon_begin (p + 1,), polygon_cell (p,): the convex polygons of the cells, for drawing.
      Polygon k has the corners ``corners[polygon_begin[k]:polygon_begin[k + 1]]`` and belongs to cell ``polygon_cell[k]``.

    Numbers of the whole map, under the names of the command line's JSON: threshold, runs, failed (counts of samples), interval
    (of failed / runs), confidence, cells, cell_size_m, face_area_m2, largest_probability, expected_failing_volume_m3,
    volume_without_face_m3.
    """

    def __init__(self, arrays, facts):
        self.__dict__.update(arrays)
        self.__dict__.update({name: value for name, value in json.loads(facts).items() if name != "files"})

    @property
    def polygons(self):
        """The polygons as a list of arrays (corners, 3) [m], in the order of ``polygon_cell``."""
        return numpy.split(self.corners, self.polygon_begin[1:-1])

    def __len__(self):
        return len(self.probability)

    def __repr__(self):
        return f"<talus.FailureMap: {len(self)} cells, {self.failed} of {self.runs} samples fail>"
