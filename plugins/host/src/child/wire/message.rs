//! Messages between the host and its child.
//!
//! One socket pair carries [`Order`]s for the child as a whole. Each open device has a pair for [`Call`](super::Call)s, which are answered in order.
//! A second pair per device carries [`Urgent`](super::Urgent) messages, which do not wait for calls. A simulated bench has a pair too.

use taceva_core::{Access, ArgValue, Descriptor, DriverKey, DriverKind, ErrorKind, Fault, Found};

use super::{Malformed, ModelOrder, OpenedDevice, Reader, Wire, fields, messages};
use crate::child::sandbox::{Confinement, Isolation};
use crate::offer::Offer;
use crate::wire_version::WIRE;

/// First message, with the limits that the child must impose on itself before it loads anything. The message also transfers the files to serve.
#[derive(Debug, PartialEq)]
pub(crate) struct Hello {
    /// Wire version of the host, [`WIRE`]. This is the first field, so a child of any version can read it.
    pub(crate) wire: u32,
    /// Process number of the host. A child with another parent process concludes that the host is gone.
    pub(crate) parent: u32,
    /// Limits that the child imposes on itself.
    pub(crate) confinement: Confinement,
    /// True if the last file of this message is the socket for the plugin's log lines.
    pub(crate) is_heard: bool,
    /// True if the child loads a plugin. Otherwise the child only reports its isolation.
    pub(crate) loads: bool,
}

messages! {
    /// The answer to [`Hello`].
    #[derive(Debug, PartialEq)]
    enum Greeting: "a greeting" {
        /// The child is confined and has loaded its plugin.
        0 => Ready { isolation: Isolation },
        /// The child could not confine itself or load its plugin, and ends.
        1 => Refused { failure: Failure },
    }

    /// Order for the child as a whole.
    #[derive(Clone, Debug, PartialEq)]
    enum Order: "an order" {
        /// Opens a device. The order transfers two sockets: for calls, and for urgent messages.
        0 => Open { kind: DriverKind, driver: DriverKey, args: Vec<(String, ArgValue)> },
        /// Describes a driver with these arguments.
        1 => Describe { driver: DriverKey, args: Vec<(String, ArgValue)> },
        /// Lists the devices that a driver finds.
        2 => Discover { driver: DriverKey },
        /// Serves a simulated bench of the rig. The order transfers a socket.
        3 => Bench { name: String },
        /// Ends the child.
        4 => Shutdown {},
        /// Makes a model. The order transfers a socket and shared memory.
        5 => Model { order: ModelOrder },
        /// Lists the drivers, estimators and needs of the library.
        6 => Offer {},
    }

    /// The answer to an [`Order`].
    #[derive(Debug, PartialEq)]
    enum OrderAnswer: "the answer to an order" {
        0 => Opened { device: OpenedDevice },
        1 => Described { descriptor: Descriptor },
        2 => Found { found: Vec<Found> },
        3 => Bench { is_there: bool },
        4 => Failed { failure: Failure },
        /// The model is being made. Its own socket reports the result.
        5 => Making {},
        6 => Offered { offer: Offer },
    }
}

/// Failed operation, with the text that the error would have without a child process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failure {
    pub(crate) kind: ErrorKind,
    /// The operation, a verb phrase that follows "cannot".
    pub(crate) doing: String,
    /// Cause, if known.
    pub(crate) cause: Option<String>,
    /// Fault with which the device stopped itself, if it did.
    pub(crate) fault: Option<Fault>,
}

fields!(Hello {
    wire,
    parent,
    confinement,
    is_heard,
    loads
});
/// First message as a child reads it, from a host with any wire version.
#[derive(Debug, PartialEq)]
pub(crate) enum FirstWord {
    /// Message of a host with the same wire version.
    Known(Hello),
    /// Wire version of another host. The rest of the message cannot be read.
    OfOtherWire(u32),
}

impl FirstWord {
    /// Error message for a host with wire version `wire`.
    pub(crate) fn refusal(wire: u32) -> String {
        format!(
            "the plugin process speaks wire version {WIRE}, the program {wire}: install the package `taceva` of the program's version ({} here), or run the program `taceva` of this package",
            env!("CARGO_PKG_VERSION")
        )
    }
}

impl Wire for FirstWord {
    fn write(&self, into: &mut Vec<u8>) {
        match self {
            FirstWord::Known(hello) => hello.write(into),
            FirstWord::OfOtherWire(wire) => wire.write(into),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<FirstWord, Malformed> {
        let begin = from.at;
        match u32::read(from)? {
            WIRE => {
                from.at = begin;
                Hello::read(from).map(FirstWord::Known)
            }
            wire => {
                from.at = from.bytes.len();
                Ok(FirstWord::OfOtherWire(wire))
            }
        }
    }
}

fields!(Offer {
    id,
    version,
    needs,
    provides
});
fields!(Failure {
    kind,
    doing,
    cause,
    fault
});

impl Wire for Found {
    fn write(&self, into: &mut Vec<u8>) {
        self.driver.write(into);
        self.title.write(into);
        self.arguments.write(into);
        match &self.access {
            Access::Ready => 0_u8.write(into),
            Access::Denied { remedy } => (1_u8, remedy.clone()).write(into),
            // `Access` can get further variants. They count as busy.
            _ => 2_u8.write(into),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Found, Malformed> {
        Ok(Found::new(Wire::read(from)?, String::read(from)?)
            .with_arguments(String::read(from)?)
            .with_access(match u8::read(from)? {
                0 => Access::Ready,
                1 => Access::Denied {
                    remedy: Wire::read(from)?,
                },
                2 => Access::Busy,
                _ => return Err(from.malformed("a known access to a device")),
            }))
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;
    use std::time::Duration;

    use taceva_core::{Axes, Deadline, Guard, Pose, Specimen, Speed};

    use super::*;
    use crate::child::wire::{Answer, BenchCall, Call, decode, encode};

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
            fault: Some(Fault::EmergencyStop),
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
            guard: Guard::at(taceva_core::Newton(1.5)),
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
    fn a_host_of_another_wire_is_heard_whatever_it_says_besides() {
        for behind in [&[][..], &[1, 2, 3], &[0xFF; 300]] {
            let mut bytes = Vec::new();
            (9_u32, WIRE + 1).write(&mut bytes);
            bytes.extend(behind);
            let read = decode::<(u32, FirstWord)>(&bytes);
            assert_eq!(read, Ok((9, FirstWord::OfOtherWire(WIRE + 1))));
        }
        let said = FirstWord::refusal(WIRE + 1);
        let versions = format!("wire version {WIRE}, the program {}", WIRE + 1);
        assert!(said.contains(&versions), "{said}");
        assert!(said.contains("install the package `taceva`"), "{said}");
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
