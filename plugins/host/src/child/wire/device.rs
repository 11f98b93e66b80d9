//! Calls to one open device, and their answers.

use taceva_core::{Axes, Deadline, FrameInfo, Guard, GuardedStop, Pose, Speed, Stamp, Wrench};

use super::{Failure, messages};

messages! {
    /// Properties of an open device.
    #[derive(Clone, Debug, PartialEq)]
    enum OpenedDevice: "an open device" {
        0 => Sensor { frame: FrameInfo, interrupts: bool, scenes: Option<Vec<String>> },
        1 => Robot { guarded: bool, expires: bool },
        2 => Force { axes: Axes, interrupts: bool, tare: bool },
        3 => Lighting { scenes: Vec<String> },
        4 => Changer { holds: Vec<String>, interrupts: bool },
    }

    /// A call to one device.
    #[derive(Clone, Debug, PartialEq)]
    enum Call: "a call" {
        0 => Start { deadline: Deadline },
        1 => Stop {},
        /// Passes the shared memory for frames.
        2 => Attach {},
        /// Writes the next frame into the shared memory.
        3 => Capture { deadline: Deadline },
        4 => Light { scene: String, deadline: Deadline },
        5 => Pose { deadline: Deadline },
        6 => MoveTo { target: Pose, speed: Speed, deadline: Deadline },
        7 => MoveGuarded { target: Pose, speed: Speed, guard: Guard, deadline: Deadline },
        8 => ClearHalt { deadline: Deadline },
        9 => Read { deadline: Deadline },
        10 => Zero { deadline: Deadline },
        /// Stops the device and releases its resources.
        11 => Close {},
        12 => Bring { name: String, deadline: Deadline },
        13 => MoveExpiring { target: Pose, speed: Speed, deadline: Deadline },
    }

    /// The answer to a [`Call`].
    #[derive(Debug, PartialEq)]
    enum Answer: "an answer" {
        0 => Done {},
        1 => Stamped { stamp: Stamp },
        2 => At { pose: Pose, stamp: Stamp },
        3 => Load { wrench: Wrench, stamp: Stamp, sequence: Option<u64>, lost: Option<u64> },
        4 => Stopped { stop: GuardedStop },
        5 => Failed { failure: Failure },
        6 => InPlace { name: String },
        7 => Framed { stamp: Stamp, sequence: Option<u64> },
    }

    /// Urgent message for a device. It bypasses the call queue.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    enum Urgent: "an urgent call" {
        /// Interrupts the pending call. The child does not answer.
        0 => Interrupt {},
        /// Halts the device. Answered with [`Answer::Done`] or [`Answer::Failed`].
        1 => Halt {},
    }
}
