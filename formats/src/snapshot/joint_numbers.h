#pragma once
// Numbers of joints and laws in messages: in a column of the first version, or by name.

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "snapshot/fields.h"

namespace talus::formats {

/// The column of a message that is for a name; null when there is none.
template <class Columns, class Message>
std::vector<double>* columnOf(const Columns& columns, std::string_view name, Message& message) {
    for (const auto& [column_name, values] : columns)
        if (column_name == name) return &(message.*values);
    return nullptr;
}

inline std::unique_ptr<fb::JointNumbersT> jointNumbers(std::string_view name, std::vector<double> values) {
    auto numbers = std::make_unique<fb::JointNumbersT>();
    numbers->name = name;
    numbers->values = std::move(values);
    return numbers;
}

}  // namespace talus::formats
