#pragma once
// The formulas under `talus theory`, each a subcommand of its own.

#include <memory>
#include <string>

#include "cli/command.h"

namespace CLI {
class Validator;
}

namespace talus::tools {

/// A finite number from low to high.
CLI::Validator within(double low, double high);

/// A formula's subcommand of `theory`; --json and --quiet may stand before or behind its name.
CLI::App* addFormula(CLI::App& theory, Common& common, const std::string& name, const std::string& what,
                     const std::string& example);

Command addSliding(CLI::App& theory, std::shared_ptr<Common> common);
Command addToppling(CLI::App& theory, std::shared_ptr<Common> common);
Command addCrack(CLI::App& theory, std::shared_ptr<Common> common);
Command addDrop(CLI::App& theory, std::shared_ptr<Common> common);
Command addTable1(CLI::App& theory, std::shared_ptr<Common> common);

}  // namespace talus::tools
