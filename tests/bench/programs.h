// The programs that are measured. Each writes `blocks` blocks, or a few less, and gives the number
// of those that the control executes.
#pragma once

#include "program_file.h"

namespace ncvet::bench {

/// How the blocks of a surfacing program are spelled.
enum class Spelling : uint8_t {
  Modal,   ///< `X1.234 Y5.678 Z-1.2345`: a code is written where it changes
  Numbered ///< `N120 G1 X1.234 Y5.678 Z-1.2345`: each block has its number and its code
};
/// What begins a program and ends it.
enum class Frame : uint8_t {
  Tape, ///< `%` and the number of the program
  File  ///< nothing: LinuxCNC knows programs by their files
};

// milling_programs.cpp
uint64_t writeSurfacing(ProgramFile &out, uint64_t blocks, Spelling spelling,
                        Frame frame = Frame::Tape);
uint64_t writeSinumerikSurfacing(ProgramFile &out, uint64_t blocks);
uint64_t writeContours(ProgramFile &out, uint64_t blocks, Frame frame = Frame::Tape);
uint64_t writeDrilling(ProgramFile &out, uint64_t blocks, Frame frame = Frame::Tape);

// other_programs.cpp
uint64_t writeTiny(ProgramFile &out);
uint64_t writeTinySinumerik(ProgramFile &out);
uint64_t writeTurning(ProgramFile &out, uint64_t blocks);
/// `lines`: of which seven in ten are comments and blank lines.
uint64_t writeCommented(ProgramFile &out, uint64_t lines);
uint64_t writeLongLines(ProgramFile &out, uint64_t blocks);
/// Loops, conditions and calls that execute `blocks` blocks, to within one round of a loop.
uint64_t writeMacros(ProgramFile &out, uint64_t blocks);
/// `programs` subprograms on three levels, of which each calls three of the level below.
uint64_t writeSubprograms(ProgramFile &out, uint64_t programs);

// linuxcnc_programs.cpp
/// The tools of the programs, as `rs274` reads them.
void writeToolTable(const std::string &path);
/// As `writeMacros`, with words of structured flow.
uint64_t writeBracketedMacros(ProgramFile &out, uint64_t blocks);

} // namespace ncvet::bench
