//! Calls of a host on a robot.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use taceva_plugin::abi::{Motion, RobotCalls, Stamp, Status};

use crate::fake_host::{Ended, Open, ended};

impl Open {
    /// Begins a motion and returns its token.
    pub(crate) fn move_to(&self, asked: &Motion) -> Result<u64, Ended> {
        let move_to = self.calls::<RobotCalls>().move_to.expect("a function");
        let (asked, mut token) = (&raw const *asked, 0);
        // SAFETY: all places live for the call.
        match ended(|error| unsafe { move_to(self.handle(), asked, &raw mut token, error) }) {
            (Status::OK, _) => Ok(token),
            refused => Err(refused),
        }
    }

    /// Waits for the motion of `token` and returns the stamp of its end.
    pub(crate) fn wait(&self, token: u64, timeout_ns: u64) -> Result<Stamp, Ended> {
        let wait = self.calls::<RobotCalls>().wait.expect("a function");
        let mut stamp = Stamp::default();
        let place = &raw mut stamp;
        // SAFETY: the place lives for the call.
        match ended(|error| unsafe { wait(self.handle(), token, place, timeout_ns, error) }) {
            (Status::OK, _) => Ok(stamp),
            refused => Err(refused),
        }
    }
}
