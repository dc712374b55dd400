#include "hal/trigger_line.h"

#include "tests/contract/device_contract.h"

namespace sparsight::contract {
namespace {

class TriggerLineContract : public DeviceContract<TriggerLine> {};
SPARSIGHT_DEVICE_CONTRACT(TriggerLineContract)

TEST_P(TriggerLineContract, EdgesOfAllLinesComeInTheOrderOfTheirTimes) {
  start();
  const auto edges = read_all(device());
  ASSERT_GE(edges.size(), 10U);
  for (std::size_t i = 1; i < edges.size(); ++i) EXPECT_GE(edges[i].time, edges[i - 1].time);
}

TEST_P(TriggerLineContract, CountersAgreeWithWhatWasRead) {
  start();
  const auto edges = read_all(device());
  EXPECT_EQ(device().counters().edges, edges.size());
  EXPECT_LE(device().counters().repeated, edges.size());
}

INSTANTIATE_TEST_SUITE_P(TriggerLines, TriggerLineContract,
                         ::testing::ValuesIn(registered<Implementation<TriggerLine>>()),
                         NameOfImplementation());

}  // namespace
}  // namespace sparsight::contract
