#pragma once
// numpy arrays of C++ data.

#include <pybind11/numpy.h>

#include <utility>
#include <vector>

#include "talus/frame.h"

namespace talus::python {

namespace py = pybind11;

/// Takes the vector over: nothing is copied.
template <class Number>
py::array_t<Number> ownedArray(std::vector<Number> values, std::vector<py::ssize_t> shape = {}) {
    auto* kept = new std::vector<Number>(std::move(values));
    const py::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<Number>*>(vector); });
    if (shape.empty()) shape = {static_cast<py::ssize_t>(kept->size())};
    return py::array_t<Number>(shape, kept->data(), owner);
}

/// (items, 3)
template <class Number>
py::array_t<Number> vectorArray(const VectorList<Number>& list) {
    std::vector<Number> flat;
    flat.reserve(3 * list.x.size());
    for (std::size_t k = 0; k < list.x.size(); ++k)
        flat.insert(flat.end(), {list.x[k], list.y[k], list.z[k]});
    return ownedArray(std::move(flat), {static_cast<py::ssize_t>(list.x.size()), 3});
}

/// A view of memory that `owner` keeps, which Python may read but not write.
inline py::array_t<double> lentArray(const double* values, std::vector<py::ssize_t> shape,
                                     std::vector<py::ssize_t> strides, const py::handle& owner) {
    py::array_t<double> array(std::move(shape), std::move(strides), values, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// Contact points of a full frame: {"position": ..., "gap": ..., ...}, an entry each.
py::dict contactArrays(const FullFrame& frame);

}  // namespace talus::python
