// A run from the command line to the image, as rank 0 sees it: probe, plan, render, stitch, record.
#pragma once

#include "options.h"
#include "run_record.h"
#include "transport.h"
#include "worker.h"

#include <map>
#include <string>
#include <vector>

namespace mpipov {

struct JobSetup {
    Options options;
    std::vector<std::string> command;             // our argv, for the record
    std::map<std::string, std::string> versions;  // without POV-Ray's
    RankRecord rank0;                             // host and slots of rank 0
    int pool0 = 1;          // what it may use where the others of its host render nothing
    int ranks_of_host = 1;  // of rank 0's
};

// Returns when the image and the record are written, or the plan is printed (--dry-run). Throws
// Failure. The other ranks must be waiting for messages; telling them to stop is the caller's.
void run_job(const JobSetup& setup, Transport& transport, Worker& worker);

}  // namespace mpipov
