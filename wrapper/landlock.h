// What a program may reach of the file system, as the kernel enforces it (Landlock, landlock(7)):
// also for root, and for what the program itself starts. Links are followed before anything is
// checked. What it has open already stays open, and that a file of some name exists can still be
// found out.
#pragma once

#include "fd.h"

#include <filesystem>
#include <vector>

namespace mpipov {

// Files, or folders with all that is in them; what is not there, or is a link, is passed over.
// Nothing else can be read, listed, written, made, removed or executed.
struct FileAccess {
    std::vector<std::filesystem::path> read, write,
        execute;  // to write and to execute: to read too
};

// Whether this kernel can enforce it: from Linux 5.13 on, where it is built in and no sandbox
// around us forbids it.
bool can_restrict_files();

// Puts what links lead to now in their place: what is allowed is not followed any more when it is
// used, so that nobody can put a link there meanwhile. In a folder that everybody may write to it
// never is.
void resolve_links(FileAccess& access);

// For mpipov-guard, which puts it on itself. Throws std::system_error.
Fd make_ruleset(const FileAccess& access);

}  // namespace mpipov
