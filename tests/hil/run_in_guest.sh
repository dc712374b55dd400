# What runs in the guest: a rig's devices are made, then `sparsight hil` plays a recording into them
# while `sparsight run` reads them, once for each scenario. Each leaves /out/SCENARIO for
# tests/hil to judge; nothing is judged here.
#
# /guest holds recording.mcap, profile.toml and scenarios, a line each: name, then what hil is given.

say() { echo "[$(cut -d ' ' -f 1 /proc/uptime)] $*"; }

make_lines() {  # a GPIO chip of eight lines, low all of them
  modprobe configfs
  mount -t configfs configfs /sys/kernel/config
  modprobe gpio-sim
  rig=/sys/kernel/config/gpio-sim/rig
  mkdir -p $rig/bank0
  echo 8 >$rig/bank0/num_lines
  echo rig >$rig/bank0/label
  echo 1 >$rig/live
  chip=/dev/$(cat $rig/bank0/chip_name)
}

make_camera() {
  modprobe v4l2loopback devices=1 video_nr=10 card_label=rig exclusive_caps=0 max_buffers=8
}

processor_times() {  # process: of each thread its name, and hundredths of a second as user and kernel
  for thread in /proc/"$1"/task/*; do
    echo "$(cat "$thread/comm") $(sed 's/.*) //' "$thread/stat" | cut -d ' ' -f 12,13)"
  done
}

play() {  # scenario, arguments of hil
  out=/out/$1
  shift
  mkdir -p "$out"
  rm -f /tmp/rig.toml
  sparsight hil /guest/recording.mcap --chip "$chip" --write-rig /tmp/rig.toml --lead 4 --json "$@" \
    >"$out/hil.json" 2>"$out/hil.txt" &
  hil=$!
  while [ ! -e /tmp/rig.toml ] && kill -0 $hil 2>/dev/null; do sleep 0.1; done
  sparsight run --rig /tmp/rig.toml --profile /guest/profile.toml --no-map --json \
    --output "$out/session" >"$out/states.jsonl" 2>"$out/run.txt" &
  run=$!
  wait $hil
  echo $? >"$out/hil.status"
  sleep 0.5
  processor_times $run >"$out/threads.txt"
  kill -TERM $run
  wait $run
  echo $? >"$out/run.status"
  cp /tmp/rig.toml "$out/"
}

make_lines
make_camera
while read -r scenario arguments; do
  say "$scenario"
  # shellcheck disable=SC2086: words of their own
  play "$scenario" $arguments </dev/null
  tail -n 3 "/out/$scenario/run.txt" "/out/$scenario/hil.txt"
done </guest/scenarios
say 'done'
