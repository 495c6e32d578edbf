// Going on from what an interrupted run left, and leaving something to go on from.
#pragma once

#include "coordinator.h"
#include "failure.h"
#include "journal.h"
#include "options.h"
#include "scene_plan.h"

#include <exception>

namespace mpipov {

// Gives `plan` the grid of the journal's run, whatever it would have chosen. Throws
// Failure(Exit::usage) where --shape, --seams or --sections asks for another one,
// Failure(Exit::file) where the journal is damaged.
void take_grid(Plan& plan, const Journal& journal, const Options& options);

// Hands the journal's finished sections to the coordinator; returns how many. Throws as
// Journal::read does.
int take_finished_sections(Coordinator& coordinator, const Journal& journal);

// How a run ends that `error` ended after its journal began; `coordinator` may be null. A new
// journal without finished sections is removed, another one is kept, and the failure says so. What
// is no Failure: Exit::file where memory is short, else Exit::interrupted.
Failure end_of_run(const std::exception& error, Journal* journal, const Coordinator* coordinator,
                   bool resumed);

}  // namespace mpipov
