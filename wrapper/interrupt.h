// SIGINT, SIGTERM and SIGHUP, kept pending and asked for between two steps of the work, so that
// temporary files are removed on the way out and no handler needs global state. SIGPIPE is ignored:
// writing fails instead.
#pragma once

namespace mpipov {

// Call in main before the first thread starts: threads inherit the mask.
void block_interrupts();

bool interrupted();

// Throws Failure(Exit::interrupted).
void throw_if_interrupted();

}  // namespace mpipov
