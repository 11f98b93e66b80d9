//! What the host and its child say to each other.
//!
//! One pair of sockets carries [`Order`]s about the child as a whole. Each opened device has a pair of its own for [`Call`]s, which are
//! answered one after another, and a second one for what is [`Urgent`] and must not wait for a call. A simulated bench has a pair too.

use std::time::Duration;

use taceva_core::{
    Access, ArgValue, Axes, Deadline, Descriptor, DriverKey, DriverKind, ErrorKind, Found,
    FrameInfo, Guard, GuardedStop, Pose, Specimen, Speed, Stamp, Wrench,
};

use super::{Malformed, ModelOrder, Reader, Wire, fields, variants};
use crate::child::sandbox::{Confinement, Isolation};

/// The first word: what the child must do before it loads anything. The files to serve come beside it.
#[derive(Debug, PartialEq)]
pub(crate) struct Hello {
    /// The process that started it; another parent means that one is gone.
    pub(crate) parent: u32,
    /// What to confine itself to.
    pub(crate) confinement: Confinement,
    /// Whether the last file beside it is the socket for what its plugin logs.
    pub(crate) is_heard: bool,
    /// Whether it loads anything; one that does not only shows what is enforced.
    pub(crate) loads: bool,
}

/// The answer to [`Hello`].
#[derive(Debug, PartialEq)]
pub(crate) enum Greeting {
    /// It is confined and has loaded what it serves.
    Ready {
        /// What is enforced.
        isolation: Isolation,
    },
    /// It could not, and ends.
    Refused { failure: Failure },
}

/// What is asked of the child as a whole.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Order {
    /// Opens a device. Two sockets come beside it: for its calls, and for what is urgent.
    Open {
        kind: DriverKind,
        driver: DriverKey,
        args: Vec<(String, ArgValue)>,
    },
    /// What is known about a driver with these arguments.
    Describe {
        driver: DriverKey,
        args: Vec<(String, ArgValue)>,
    },
    /// The devices that a driver sees.
    Discover { driver: DriverKey },
    /// Serves a simulated bench of the rig; a socket comes beside it.
    Bench { name: String },
    /// Makes a model; a socket comes beside it, and memory.
    Model { order: ModelOrder },
    /// Ends the child.
    Shutdown {},
}

/// The answer to an [`Order`].
#[derive(Debug, PartialEq)]
pub(crate) enum OrderAnswer {
    Opened {
        device: OpenedDevice,
    },
    Described {
        descriptor: Descriptor,
    },
    Found {
        found: Vec<Found>,
    },
    Bench {
        is_there: bool,
    },
    Failed {
        failure: Failure,
    },
    /// It is being made; what comes of it is said by its own socket.
    Making {},
}

/// What is known about a device once it is open.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum OpenedDevice {
    Sensor {
        frame: FrameInfo,
        interrupts: bool,
        scenes: Option<Vec<String>>,
    },
    Robot {
        guarded: bool,
    },
    Force {
        axes: Axes,
        interrupts: bool,
        tare: bool,
    },
    Lighting {
        scenes: Vec<String>,
    },
}

/// A call to one device.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Call {
    Start {
        deadline: Deadline,
    },
    Stop {},
    /// The memory for frames comes beside it.
    Attach {},
    /// Writes the next frame into that memory.
    Capture {
        deadline: Deadline,
    },
    Light {
        scene: String,
        deadline: Deadline,
    },
    Pose {
        deadline: Deadline,
    },
    MoveTo {
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    },
    MoveGuarded {
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    },
    ClearHalt {
        deadline: Deadline,
    },
    Read {
        deadline: Deadline,
    },
    Zero {
        deadline: Deadline,
    },
    /// Stops the device and gives back what it holds.
    Close {},
}

/// The answer to a [`Call`].
#[derive(Debug, PartialEq)]
pub(crate) enum Answer {
    Done {},
    Stamped { stamp: Stamp },
    At { pose: Pose, stamp: Stamp },
    Load { wrench: Wrench, stamp: Stamp },
    Stopped { stop: GuardedStop },
    Failed { failure: Failure },
}

/// What goes round the queue of a device's calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Urgent {
    /// Nobody waits for an answer.
    Interrupt {},
    /// Answered with [`Answer::Done`] or [`Answer::Failed`].
    Halt {},
}

/// A call to a simulated bench.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum BenchCall {
    Now {},
    Rest { rest: Duration },
    Mount { specimen: Specimen },
    NamePress { name: u64 },
    Schedule { at: Duration },
    Provenance {},
}

/// The answer to a [`BenchCall`].
#[derive(Debug, PartialEq)]
pub(crate) enum BenchAnswer {
    Done {},
    Now { now: Duration },
    Provenance { text: Option<String> },
    Failed { failure: Failure },
}

/// Why something was not done, in the words that it would have had without a child.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failure {
    pub(crate) kind: ErrorKind,
    /// What could not be done, in words that follow "cannot".
    pub(crate) doing: String,
    /// What caused it, if that was said.
    pub(crate) cause: Option<String>,
}

fields!(Hello {
    parent,
    confinement,
    is_heard,
    loads
});
fields!(Failure { kind, doing, cause });

variants!(Greeting, "a greeting" {
    0 => Ready { isolation },
    1 => Refused { failure },
});

variants!(Order, "an order" {
    0 => Open { kind, driver, args },
    1 => Describe { driver, args },
    2 => Discover { driver },
    3 => Bench { name },
    4 => Shutdown {},
    5 => Model { order },
});

variants!(OrderAnswer, "the answer to an order" {
    0 => Opened { device },
    1 => Described { descriptor },
    2 => Found { found },
    3 => Bench { is_there },
    4 => Failed { failure },
    5 => Making {},
});

variants!(OpenedDevice, "an open device" {
    0 => Sensor { frame, interrupts, scenes },
    1 => Robot { guarded },
    2 => Force { axes, interrupts, tare },
    3 => Lighting { scenes },
});

variants!(Call, "a call" {
    0 => Start { deadline },
    1 => Stop {},
    2 => Attach {},
    3 => Capture { deadline },
    4 => Light { scene, deadline },
    5 => Pose { deadline },
    6 => MoveTo { target, speed, deadline },
    7 => MoveGuarded { target, speed, guard, deadline },
    8 => ClearHalt { deadline },
    9 => Read { deadline },
    10 => Zero { deadline },
    11 => Close {},
});

variants!(Answer, "an answer" {
    0 => Done {},
    1 => Stamped { stamp },
    2 => At { pose, stamp },
    3 => Load { wrench, stamp },
    4 => Stopped { stop },
    5 => Failed { failure },
});

variants!(Urgent, "an urgent call" {
    0 => Interrupt {},
    1 => Halt {},
});

variants!(BenchCall, "a call to a bench" {
    0 => Now {},
    1 => Rest { rest },
    2 => Mount { specimen },
    3 => NamePress { name },
    4 => Schedule { at },
    5 => Provenance {},
});

variants!(BenchAnswer, "the answer of a bench" {
    0 => Done {},
    1 => Now { now },
    2 => Provenance { text },
    3 => Failed { failure },
});

impl Wire for Found {
    fn write(&self, into: &mut Vec<u8>) {
        self.driver.write(into);
        self.title.write(into);
        self.arguments.write(into);
        match &self.access {
            Access::Ready => 0_u8.write(into),
            Access::Denied { remedy } => (1_u8, remedy.clone()).write(into),
            // `Access` can grow; whatever is neither ready nor denied cannot be opened now.
            _ => 2_u8.write(into),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Found, Malformed> {
        Ok(Found {
            driver: Wire::read(from)?,
            title: Wire::read(from)?,
            arguments: Wire::read(from)?,
            access: match u8::read(from)? {
                0 => Access::Ready,
                1 => Access::Denied {
                    remedy: Wire::read(from)?,
                },
                2 => Access::Busy,
                _ => return Err(from.malformed("whether a device could be opened")),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;

    use super::*;
    use crate::child::wire::{decode, encode};

    fn survives<T: Wire + PartialEq + Debug>(message: T) -> Vec<u8> {
        let mut bytes = Vec::new();
        encode(&message, &mut bytes).expect("short");
        assert_eq!(decode::<T>(&bytes).as_ref(), Ok(&message));
        bytes
    }

    fn failure() -> Failure {
        Failure {
            kind: ErrorKind::Timeout,
            doing: "capture a frame".to_owned(),
            cause: Some("no frame within 40ms".to_owned()),
        }
    }

    #[test]
    fn every_kind_of_value_comes_back_as_it_went() {
        let deadline = Deadline::after(Duration::from_millis(40));
        let speed = Speed::try_new(2.5).expect("positive");
        survives(Order::Open {
            kind: DriverKind::Sensor,
            driver: DriverKey::fixed("sim/gelsight"),
            args: vec![
                ("seed".to_owned(), ArgValue::Whole(-3)),
                ("depth".to_owned(), ArgValue::Number(0.1 + 0.2)),
                ("rig".to_owned(), ArgValue::Text("bench;1".to_owned())),
                ("fast".to_owned(), ArgValue::Flag(true)),
            ],
        });
        survives(Call::MoveGuarded {
            target: Pose::default(),
            speed,
            guard: Guard {
                force: taceva_core::Newton(1.5),
            },
            deadline,
        });
        survives(OrderAnswer::Opened {
            device: OpenedDevice::Force {
                axes: Axes::SIX,
                interrupts: true,
                tare: false,
            },
        });
        survives(Answer::Failed { failure: failure() });
        survives(BenchCall::Mount {
            specimen: Specimen::Sphere {
                radius: taceva_core::Nanometre(2_000_000),
            },
        });
    }

    #[test]
    fn every_cut_and_every_damaged_byte_is_refused_or_another_message_and_never_a_panic() {
        let bytes = survives(OrderAnswer::Failed { failure: failure() });
        for cut in 0..bytes.len() {
            assert!(
                decode::<OrderAnswer>(&bytes[..cut]).is_err(),
                "cut at {cut}"
            );
        }
        for at in 0..bytes.len() {
            for flip in 0..8 {
                let mut damaged = bytes.clone();
                damaged[at] ^= 1 << flip;
                let _ = decode::<OrderAnswer>(&damaged);
                let _ = decode::<Order>(&damaged);
                let _ = decode::<Call>(&damaged);
            }
        }
    }
}
