# What runs in the guest: a rig's devices are made; then, once for each scenario, `sparsight hil` plays
# a recording into them while `sparsight run` reads them. Each leaves /out/SCENARIO for tests/hil to
# judge; nothing is judged here.
#
# /guest holds recording.mcap, profile.toml and scenarios, a line each: its name, then what hil is
# given. A function before_NAME or during_NAME, where there is one, does what else belongs to it.

ip() { /usr/bin/ip "$@"; }  # before busybox's own, which knows no namespaces

say() { echo "[$(cut -d ' ' -f 1 /proc/uptime)] $*"; }

make_lines() {  # a GPIO chip of eight lines, all low
  modprobe configfs
  mount -t configfs configfs /sys/kernel/config
  modprobe gpio-sim
  rig=/sys/kernel/config/gpio-sim/rig
  mkdir -p $rig/bank0
  echo 8 >$rig/bank0/num_lines
  echo 1 >$rig/live
  chip=/dev/$(cat $rig/bank0/chip_name)
}

make_camera() {
  modprobe v4l2loopback devices=1 video_nr=10 card_label=rig exclusive_caps=0 max_buffers=8
}

make_lidar() {  # a network card towards a sensor that has its own network, and another card
  modprobe e1000e
  ip netns add sensor
  ip link set eth0 name lidar0
  ip link set eth1 netns sensor name sensor0
  ip address add 192.168.1.100/24 dev lidar0
  ip link set lidar0 up
  ip netns exec sensor ip address add 192.168.1.201/24 dev sensor0
  ip netns exec sensor ip link set sensor0 up
}

before_disk_full() {  # sixteen megabytes above what the recorder leaves free
  mkdir -p "$out/session"
  mount -t tmpfs -o size=1040m tmpfs "$out/session"
}

# v4l2loopback cannot be taken away from a program that uses it, vivid can. Its picture is its own.
before_camera_unplugged() {
  modprobe vivid n_devs=1 node_types=0x1 num_inputs=1 input_types=0x3 ccs_cap_mode=4 vid_cap_nr=20
}
during_camera_unplugged() {
  sleep 6
  echo vivid.0 >/sys/bus/platform/drivers/vivid/unbind
  sleep 1.5
  echo vivid.0 >/sys/bus/platform/drivers/vivid/bind
}

before_packets_lost() {
  modprobe sch_netem
  ip netns exec sensor tc qdisc add dev sensor0 root netem loss 2% duplicate 1% reorder 2% delay 1ms
}

hook() {  # when, scenario
  function=$1_$(echo "$2" | tr - _)
  type "$function" >/dev/null 2>&1 && "$function"
}

# Of each thread of a process, and of the interrupts', a line: name, real-time priority,
# hundredths of a second that it ran as user and as kernel.
threads() {
  for thread in /proc/"$1"/task/* $(grep -l '^irq/' /proc/[0-9]*/comm | sed 's,/comm$,,'); do
    echo "$(cat "$thread/comm") $(sed 's/.*) //' "$thread/stat" | cut -d ' ' -f 38,12,13)"
  done
}

play() {  # scenario, arguments of hil
  scenario=$1
  shift
  out=/out/$scenario
  mkdir -p "$out"
  rm -f /tmp/rig.toml
  hook before "$scenario"
  ip netns exec sensor sparsight hil /guest/recording.mcap --chip "$chip" --lidar-to 192.168.1.100 \
    --lidar-from 192.168.1.201 --write-rig /tmp/rig.toml --lead 4 --json "$@" \
    >"$out/hil.json" 2>"$out/hil.txt" &
  hil=$!
  while [ ! -e /tmp/rig.toml ] && kill -0 $hil 2>/dev/null; do sleep 0.1; done
  cp /tmp/rig.toml "$out/"
  sparsight run --rig /tmp/rig.toml --profile /guest/profile.toml --no-map --json \
    --output "$out/session" >"$out/states.jsonl" 2>"$out/run.txt" &
  run=$!
  hook during "$scenario" &
  wait $hil
  echo $? >"$out/hil.status"
  sleep 0.5
  threads $run >"$out/threads.txt"
  kill -TERM $run
  wait $run
  echo $? >"$out/run.status"
}

# Devices are no threads: nobody throttles them.
echo -1 >/proc/sys/kernel/sched_rt_runtime_us

make_lines
make_camera
make_lidar
while read -r scenario arguments; do
  say "$scenario"
  # shellcheck disable=SC2086: words of their own
  play "$scenario" $arguments </dev/null
  cat "/out/$scenario/hil.txt" "/out/$scenario/run.txt"
done </guest/scenarios
say 'all scenarios have run'
