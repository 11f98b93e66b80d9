//! Reads force and pose of a resting tip and passes them to the supervisor.

use std::time::Duration;

use taceva_core::{Deadline, ErrorKind, Stamp, Wrench};

use super::align::Look;
use super::error::StopCause;
use super::halt_reason::Trip;
use super::load_limit::Felt;
use super::supervisor::Observation;
use super::surface_fit::DepthForce;
use super::tip::{DEADLINE, Step, Tip, is_silent};

/// Deadline of one attempt to read a force. Reading is retried until the supervisor finds the force stale.
pub(super) const READ_DEADLINE: Duration = Duration::from_millis(20);
/// Delay before the next reading after an outdated reading.
const LATE_REST: Duration = Duration::from_millis(1);
/// Maximum number of attempts without a current reading. This limit ends the loop if the clock stops.
const READ_TRIES: u32 = 64;

impl Tip<'_> {
    /// Reads force and pose of the resting tip, and passes both to the supervisor.
    pub(super) fn look(&mut self) -> Step<Look> {
        let reading = self.read_force()?;
        let asked_s = self.clock.now_s();
        let (pose, stamp) = match self.robot.pose(DEADLINE) {
            Ok(read) => read,
            // A robot that does not reply has a stale pose.
            Err(error) if is_silent(&error) => {
                let age_s = self.clock.now_s() - asked_s;
                return Err(self.halt_for(Trip::StalePose { age_s }));
            }
            Err(error) => return Err(self.failed(error)),
        };
        self.at = pose;
        let observation = Observation::Pose {
            pose,
            stamp,
            target: self.target,
        };
        self.show(&observation)?;
        let wrench = self.supervisor.lock().zeroed(&reading.said);
        self.felt = Felt::of(&wrench);
        if let Some(readings) = &mut self.readings {
            readings.push(DepthForce {
                z_mm: pose.position.z.0,
                force_n: self.felt.normal_n,
            });
        }
        Ok(Look {
            wrench,
            wrench_s: reading.valid_s,
            number: reading.number,
            pose,
            pose_s: stamp.valid_s,
        })
    }

    /// Reads a force that was measured after this call.
    ///
    /// The tip rests during the reading, so slow links and filters cost time but no travel. A reading from before this call is passed to the
    /// supervisor, and the transducer is read again.
    pub(super) fn read_force(&mut self) -> Step<Reading> {
        let asked_s = self.clock.now_s();
        for _ in 0..READ_TRIES {
            match self.force.read(Deadline::after(READ_DEADLINE)) {
                Ok((said, stamp)) => {
                    let number = self.force.sequence();
                    self.show(&observation(said, stamp, number))?;
                    let valid_s = stamp.valid_s;
                    if valid_s >= asked_s {
                        return Ok(Reading {
                            said,
                            valid_s,
                            number,
                        });
                    }
                    self.clock.rest(LATE_REST);
                }
                Err(error) if error.kind() == ErrorKind::Timeout => {
                    self.show(&Observation::Silence)?
                }
                Err(error) if error.kind() == ErrorKind::OutOfRange => {
                    let force_n = f64::INFINITY;
                    return Err(self.halt_for(Trip::Saturated { force_n }));
                }
                Err(error) => {
                    let _ = self.robot.halt();
                    return Err(StopCause::Device(error));
                }
            }
        }
        let age_s = self.clock.now_s() - asked_s;
        Err(self.halt_for(Trip::StaleForce { age_s }))
    }

    fn show(&mut self, observation: &Observation) -> Step<()> {
        let now_s = self.clock.now_s();
        let mut supervisor = self.supervisor.lock();
        let is_force = matches!(
            observation,
            Observation::Force(..) | Observation::Numbered(..)
        );
        let seen = match (self.is_guarded && is_force, supervisor.tripped()) {
            // The guard thread has already passed on this reading. Passing it on again would count as a repeated signal.
            (true, Some(trip)) => Err(trip),
            (true, None) => Ok(()),
            (false, _) => supervisor.observe(observation, now_s),
        };
        seen.map_err(StopCause::Tripped)
    }
}

/// A reading of the transducer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    /// Force as the transducer reports it, before the zero of the host is subtracted.
    pub(super) said: Wrench,
    /// Time of the measurement, in s.
    pub(super) valid_s: f64,
    /// Sequence number; `None` if the transducer does not number its readings.
    number: Option<u64>,
}

/// Observation for the supervisor of the force `said`, with the sequence number if there is one.
fn observation(said: Wrench, stamp: Stamp, number: Option<u64>) -> Observation {
    match number {
        Some(number) => Observation::Numbered(said, stamp, number),
        None => Observation::Force(said, stamp),
    }
}
