#include "drivers/vlp16/network_interface.h"

#include <gtest/gtest.h>

#include "drivers/vlp16/udp_receiver.h"

namespace sparsight {
namespace {

TEST(NetworkInterface, IsTheOneThatThePacketsLeaveBy) {
  EXPECT_EQ(interface_towards(*ipv4_address("127.0.0.1")), "lo");
}

TEST(NetworkInterface, IsNoneWhereNoRouteLeads) {
  EXPECT_FALSE(interface_towards(*ipv4_address("255.255.255.255"))) << "no broadcast is allowed";
}

}  // namespace
}  // namespace sparsight
