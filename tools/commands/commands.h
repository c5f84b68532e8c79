#pragma once
// All subcommands; each is defined in the file of its name.

#include "cli/command.h"
#include "talus/searches.h"

namespace talus::tools {

Command addRun(CLI::App& root);
Command addValidate(CLI::App& root);
Command addBlocks(CLI::App& root);
Command addTheory(CLI::App& root);
Command addPaper(CLI::App& root);
Command addInspect(CLI::App& root);
Command addExport(CLI::App& root);
Command addBatch(CLI::App& root);
Command addSample(CLI::App& root);
Command addMerge(CLI::App& root);
Command addReplay(CLI::App& root);
Command addLimitAnalysis(CLI::App& root);
Command addKeyBlocks(CLI::App& root);
Command addSupport(CLI::App& root);
Command addVerification(CLI::App& root);
Command addSchema(CLI::App& root);
Command addKinematics(CLI::App& root);
Command addReport(CLI::App& root);
Command addStorm(CLI::App& root);
Command addFlow(CLI::App& root);

/// critical-angle, safety-factor, ...: one command per search of the engine.
Command addSearch(CLI::App& root, const LoadSearch& search);

}  // namespace talus::tools
