#!/usr/bin/env bash
# Runs the command on three hosts: network namespaces joined by a bridge, each with a host name and an sshd of its own.
# Then cuts one of them off in the middle of a run, and kills the first process in another.
#
#   tests/mpi/hosts.sh PATH-OF-SPINCAT openmpi|mpich
#
# Exit code 77: cannot be tried here, with the reason.
set -euo pipefail
spincat="$1"
mpi="$2"

skip() { echo "skipped: $*"; exit 77; }
fail() { echo "FAILED: $*" >&2; tail -n 30 "$work"/*.err >&2 || true; exit 1; }

[ "$(id -u)" -eq 0 ] || skip "network namespaces need root"
for program in ip sshd ssh ssh-keygen unshare "mpirun.$mpi"; do
  command -v "$program" >/dev/null || [ -x "/usr/sbin/$program" ] || skip "$program is not installed"
done
[ -e "$(dirname "$spincat")/mpi/spincat_mpi_$mpi.so" ] || skip "the build has no plug-in for $mpi"

id="sc$$"
work="$(mktemp -d /tmp/spincat-hosts.XXXXXX)"
chmod 711 "$work"
cleanup() {
  local host
  for host in hub h0 h1 h2; do
    for process in $(ip netns pids "$id-$host" 2>/dev/null); do kill -9 "$process" 2>/dev/null || true; done
    ip netns del "$id-$host" 2>/dev/null || true
    rm -rf "/etc/netns/$id-$host"
  done
  rm -rf "$work"
}
trap cleanup EXIT
ip netns add "$id-hub" 2>"$work/netns.err" || skip "no network namespaces here: $(cat "$work/netns.err")"

ip -n "$id-hub" link add bridge type bridge || skip "no bridges here"
ip -n "$id-hub" link set bridge up
ssh-keygen -q -t ed25519 -N '' -f "$work/key"
cp "$work/key.pub" "$work/authorized"
cat >"$work/ssh" <<SSH
#!/bin/sh
exec ssh -i $work/key -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o LogLevel=ERROR "\$@"
SSH
chmod 755 "$work/ssh"
mkdir -p /run/sshd
printf 'HostKey %s/key\nAuthorizedKeysFile %s/authorized\nStrictModes no\nUsePAM no\nPidFile none\nPermitRootLogin yes\n' \
  "$work" "$work" >"$work/sshd_config"
sshd="$(command -v sshd || echo /usr/sbin/sshd)"
for i in 0 1 2; do
  host="h$i"
  space="$id-$host"
  ip netns add "$space"
  ip link add "eth0" netns "$space" type veth peer name "port$i" netns "$id-hub"
  ip -n "$id-hub" link set "port$i" master bridge up
  ip -n "$space" link set lo up
  ip -n "$space" address add "10.77.0.1$i/24" dev eth0
  ip -n "$space" link set eth0 up
  mkdir -p "/etc/netns/$space"
  printf '127.0.0.1 localhost\n10.77.0.10 h0\n10.77.0.11 h1\n10.77.0.12 h2\n' >"/etc/netns/$space/hosts"
  ip netns exec "$space" unshare -u sh -c "hostname $host; exec $sshd -f $work/sshd_config -D" >"$work/sshd-$i.err" 2>&1 </dev/null &
done

# A command line on rank 0's host.
on_h0() { ip netns exec "$id-h0" unshare -u sh -c 'hostname h0; exec "$@"' sh "$@"; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_plm_rsh_agent="$work/ssh"
export UCX_TLS=tcp,self UCX_NET_DEVICES=eth0
launcher() {  # the hosts, comma-separated
  if [ "$mpi" = openmpi ]; then
    echo "mpirun.openmpi --host $1 --map-by node --bind-to none --enable-recovery --mca btl self,vader,tcp --mca btl_tcp_if_include eth0 --mca oob_tcp_if_include eth0 -x SPINCAT_DEADLINE"
  else
    echo "mpirun.mpich -launcher ssh -launcher-exec $work/ssh -hosts $1"
  fi
}
export SPINCAT_DEADLINE=20  # a rank that hangs at its end must not end itself in time

# A surface that takes some seconds.
awk 'BEGIN{n=70;
  printf "OFF\n%d %d 0\n",2*n*n,(n-1)*2*n; p=3.14159265358979; for(i=0;i<n;i++)for(j=0;j<2*n;j++){t=(i+.5)*p/n;f=j*p/n;r=1+.1*sin(5*t)*cos(3*f);print r*sin(t)*cos(f),r*sin(t)*sin(f),r*cos(t)} for(i=0;i<n-1;i++)for(j=0;j<2*n;j++){k=(j+1)%(2*n);print 4,i*2*n+j,(i+1)*2*n+j,(i+1)*2*n+k,i*2*n+k}}' >"$work/scan.off"
for i in 0 1 2; do  # each host answers
  for _ in $(seq 100); do
    on_h0 "$work/ssh" "h$i" true 2>/dev/null && break
    sleep 0.05
  done
  on_h0 "$work/ssh" "h$i" hostname >"$work/name.$i" 2>"$work/ssh-$i.err" || fail "h$i does not answer"
done

arguments=(spin "$work/scan.off" --image-width 40 --threads 1)
"$spincat" "${arguments[@]}" -o "$work/alone.npy" >/dev/null

# So many ranks on these hosts; the last line has the words.
run_on() {
  on_h0 timeout -k 1 60 $(launcher "$2") -n "$1" "$spincat" "${arguments[@]}" -o "$work/ranks.npy" \
    >"$work/run.out" 2>"$work/run.err" </dev/null || fail "$1 ranks on $2"
  grep -q "$3" "$work/run.err" || fail "$1 ranks on $2: not $3"
  cmp "$work/alone.npy" "$work/ranks.npy" || fail "other bytes of $1 ranks on $2"
  rm "$work/ranks.npy"
}
# Several times: MPI's end is where ranks on several hosts may wait for each other.
for _ in 1 2 3; do
  run_on 2 h0,h1 "2 ranks on 2 hosts"
  run_on 3 h0,h1,h2 "3 ranks on 3 hosts"
done
if [ "$mpi" = openmpi ]; then
  run_on 4 h0:2,h1:2 "4 ranks on 2 hosts"
else
  run_on 4 h0,h1 "4 ranks on 2 hosts"  # in turns
fi

# Cut off h2 once some tasks are done. The launcher may wait for ever; the result is the proof.
export SPINCAT_DEADLINE=1
on_h0 timeout -k 1 60 $(launcher h0,h1,h2) -n 3 "$spincat" "${arguments[@]}" -o "$work/ranks.npy" \
  >"$work/cut.out" 2>"$work/cut.err" </dev/null &
run=$!
for _ in $(seq 600); do
  [ -e "$work/ranks.npy" ] && break
  [ "$(stat -c %s "$work/ranks.npy.journal" 2>/dev/null || echo 0)" -gt 2000000 ] && break
  sleep 0.02
done
ip -n "$id-hub" link set port2 down
for _ in $(seq 600); do
  [ -e "$work/ranks.npy" ] && break
  kill -0 "$run" 2>/dev/null || break
  sleep 0.1
done
if [ ! -e "$work/ranks.npy" ]; then
  # This launcher ends the run with the host. The same command on the hosts that are left goes on.
  wait "$run" || true
  on_h0 timeout -k 1 60 $(launcher h0,h1) -n 2 "$spincat" "${arguments[@]}" -o "$work/ranks.npy" \
    >"$work/again.out" 2>"$work/again.err" </dev/null || fail "the resumed run"
fi
cmp "$work/alone.npy" "$work/ranks.npy" || fail "other bytes after a cut link"

# The process of rank 0 on its host, once it is there.
rank0() {
  local process
  for process in $(ip netns pids "$id-h0"); do
    if tr '\0' '\n' <"/proc/$process/environ" 2>/dev/null | grep -qE '^(PMI|OMPI_COMM_WORLD)_RANK=0$'; then
      echo "$process"
      return
    fi
  done
}

# Kill rank 0 once some tasks are done. One launcher ends the run; under the other the rank on the other host leaves when
# it has heard nothing for long. A run that was done before it was killed shows nothing: once more.
export SPINCAT_DEADLINE=0.1
for _ in 1 2 3 4 5; do
  rm -f "$work/ranks.npy" "$work/ranks.npy.journal"
  begun=$SECONDS
  on_h0 timeout -k 1 60 $(launcher h0,h1) -n 2 "$spincat" "${arguments[@]}" -o "$work/ranks.npy" \
    >"$work/kill.out" 2>"$work/kill.err" </dev/null &
  run=$!
  process=""
  until [ -n "$process" ] || ! kill -0 "$run" 2>/dev/null; do process="$(rank0)"; done
  until [ -s "$work/ranks.npy.journal" ] || [ -e "$work/ranks.npy" ] || ! kill -0 "$run" 2>/dev/null; do sleep 0.01; done
  killed=""
  if [ -n "$process" ] && kill -9 "$process" 2>/dev/null; then killed=yes; fi
  wait "$run" || true
  [ -z "$killed" ] || [ -e "$work/ranks.npy" ] || break
done
[ -n "$killed" ] && [ ! -e "$work/ranks.npy" ] || fail "rank 0 was not killed in time"
[ $((SECONDS - begun)) -lt 59 ] || fail "a rank stays when rank 0 has gone"
export SPINCAT_DEADLINE=1
on_h0 timeout -k 1 60 $(launcher h0,h1) -n 2 "$spincat" "${arguments[@]}" -o "$work/ranks.npy" \
  >"$work/again.out" 2>"$work/again.err" </dev/null || fail "the run after rank 0 was lost"
cmp "$work/alone.npy" "$work/ranks.npy" || fail "other bytes after rank 0 was lost"
echo "three hosts, a cut link and a lost rank 0: the same bytes"
