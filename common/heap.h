// Memory that a long-lived program has freed goes back to the system. With other C libraries than
// glibc nothing is done.
#pragma once

namespace relief {

/// Makes blocks from 256 KB on go back when they are freed. For a program's start. By default glibc
/// raises that limit up to 32 MB, and keeps gaps that it can't fill: with tiles that come and go
/// the window had a seventh more memory. With smaller blocks Mesa's software renderer, which takes
/// some of 64 KB for each frame, would be slower. For the same reason up to 16 MB at the heap's end
/// stay until return_free_memory(): with glibc's 128 KB a frame of the orbiting Dragon took 36 ms,
/// not 17.
void return_large_blocks();

/// Gives back what is free now, in 2 to 13 ms where that is 100 MB.
void return_free_memory();

}  // namespace relief
