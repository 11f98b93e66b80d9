#!/usr/bin/env bash
# Starts a Slurm of two virtual nodes on this machine, on loopback only, and waits until both are idle: `up.sh FOLDER PORT`. It uses the
# ports PORT to PORT + 2 and keeps all files in FOLDER; `down.sh FOLDER` ends it. Needs root, and Debian's
# slurm-wlm and munge.
set -eu
folder=$1 port=$2
host=$(hostname -s)
mkdir -p "$folder"/state "$folder"/logs "$folder"/munge
# munged rejects folders that others may write to.
chmod 755 "$folder"
chmod 700 "$folder"/munge
[ -s "$folder"/munge/key ] || (umask 077; head -c 1024 /dev/urandom >"$folder"/munge/key)
munged --force --num-threads=2 --key-file="$folder"/munge/key --socket="$folder"/munge.socket --pid-file="$folder"/munge/pid \
    --seed-file="$folder"/munge/seed --log-file="$folder"/logs/munged.log

cat >"$folder"/slurm.conf <<CONFIGURATION
ClusterName=taceva$port
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/logs/slurmctld.log
SlurmdLogFile=$folder/logs/slurmd-%n.log
# Without systemd, cgroups and accounting.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
InactiveLimit=0
KillWait=5
# A lost node is noticed within seconds, but a busy machine is not mistaken for one.
SlurmdTimeout=${SLURMD_TIMEOUT:-20}
SlurmctldTimeout=20
JobRequeue=1
MaxArraySize=${MAX_ARRAY_SIZE:-1001}
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2 RealMemory=2000 State=UNKNOWN
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2 RealMemory=2000 State=UNKNOWN
PartitionName=main Nodes=one,two Default=YES MaxTime=60 State=UP
CONFIGURATION
printf 'CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n' >"$folder"/cgroup.conf
export SLURM_CONF=$folder/slurm.conf
slurmctld -f "$SLURM_CONF" -c
slurmd -f "$SLURM_CONF" -N one
slurmd -f "$SLURM_CONF" -N two
while [ $SECONDS -lt 120 ]; do
    [ "$(sinfo --noheader --states=idle --format=%D 2>/dev/null)" = 2 ] && exit 0
    sleep 0.25
done
echo "the nodes did not become idle" >&2
sinfo --Node --long >&2 || true
exit 1
