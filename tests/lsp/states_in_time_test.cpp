// A question about the machine's state does not wait for the check of a long text.
#include "interp/state/state.h"
#include "lsp/server/states_in_time.h"

#include "gtest/gtest.h"

namespace ncvet::lsp {
namespace {

CheckJob jobOf(const std::string &text) {
  CheckJob job;
  SessionOptions options;
  options.dialect = "haas-mill";
  job.session = std::make_shared<Session>(options);
  job.overlay = std::make_shared<SourceSet::Overlay>();
  job.document.path = "/nowhere/O0001.nc";
  job.document.text = textOf(text);
  job.document.memory = std::make_shared<DocumentMemory>();
  return job;
}

const std::string text = "%\nO1 (LONG)\nG21 G90 G94\nG0 X1. Y2.\nX3.\nM30\n%\n";
const auto block = uint32_t(text.find("X3."));

TEST(StatesInTime, AreNotWaitedForWhileALongTextIsChecked) {
  const CheckJob job = jobOf(text);
  const std::atomic<bool> cancelled = false;
  StatesInTime states;
  job.document.memory->takesLong = true;
  {
    // What a check holds from its begin to its end.
    const std::lock_guard<std::mutex> check(job.document.memory->mutex);
    EXPECT_EQ(states.at(job, block, cancelled), nullptr);
    EXPECT_EQ(states.at(job, block, cancelled), nullptr);
  }
  StatesInTime::States known;
  while (!known) // the thread that was asked goes on now
    known = states.at(job, block, cancelled);
  const MachineState *const before = known->firstBefore();
  ASSERT_NE(before, nullptr);
  EXPECT_EQ(before->at(Axis::X).value(), 1);
  states.stop();
}

TEST(StatesInTime, AreKnownAtOnceInATextThatIsCheckedQuickly) {
  const CheckJob job = jobOf(text);
  const std::atomic<bool> cancelled = false;
  StatesInTime states;
  const StatesInTime::States known = states.at(job, block, cancelled);
  ASSERT_NE(known, nullptr);
  EXPECT_NE(known->firstBefore(), nullptr);
  states.stop();
}

} // namespace
} // namespace ncvet::lsp
