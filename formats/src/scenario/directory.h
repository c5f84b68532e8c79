#pragma once
// Finds blocks by name without building them: blocks of stacks by taking the name apart, others from a map.

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "scenario/placed_block.h"
#include "scenario/reading.h"
#include "scenario/stack.h"

namespace talus::formats::scenario {

class BlockDirectory {
 public:
    /// Reports names that are there twice. The blocks' indices are those of a model with the stacks in order,
    /// then the placed blocks. Both vectors must outlive the directory.
    BlockDirectory(Report& report, const std::vector<Stack>& stacks, const std::vector<PlacedBlock>& placed);

    /// Adds blocks behind the placed ones, from index `first` on; names that are there already are reported.
    void add(Report& report, const std::vector<std::string>& names, std::int32_t first, Place place,
             const std::string& field);

    /// Blocks could not be made, so that unknown names are not to be reported.
    void setIncomplete() { complete_ = false; }

    /// Index of a block, or nothing.
    std::optional<std::int32_t> find(const std::string& name) const;

    /// The same for a name a user wrote; an unknown one is reported, unless some blocks' names could not be
    /// read.
    std::optional<std::int32_t> resolve(Report& report, Place place, const std::string& field,
                                        const std::string& name) const;

    /// Looks up all names of a list of strings; they must differ.
    void checkNames(Report& report, Node list, const std::string& field) const;

 private:
    void addStackName(Report& report, std::size_t index);
    void addPlaced(Report& report, const std::vector<PlacedBlock>& placed);
    std::optional<std::int32_t> findInStack(const Stack& stack, const std::string& name) const;
    std::string hint(const std::string& name) const;
    std::vector<std::string> candidates() const;

    const std::vector<Stack>& stacks_;
    std::unordered_map<std::string, std::size_t> stack_by_name_;
    std::unordered_map<std::string, std::int32_t> placed_;
    std::vector<std::string> placed_names_;
    std::int32_t first_placed_ = 0;
    bool complete_ = true;
};

}  // namespace talus::formats::scenario
