//! Checks of drivers of every kind.

#![expect(
    unsafe_code,
    reason = "the test calls functions of the factory with arguments that no host passes"
)]

use std::mem::offset_of;
use std::thread;

use taceva_abi as abi;
use taceva_core::{ArgKind, ArgValue, Args, DriverKind, ErrorKind};

use super::call_name::OPENING;
use super::subject::{Draw, Subject, bare, writable_memory};
use super::{Check, Of};
use crate::promise::{Unmet, broken, expect, refused, skipped};
use taceva_host::Session;
use taceva_host::bare::Opened;
use taceva_host::bare::{ArgList, Taken, pending_call, take};

const OF: Of = Of::Driver;

pub(super) const CHECKS: &[Check] = &[
    OF.check("driver/describes-the-same-twice", describes_twice),
    OF.check("driver/describes-every-argument", describes_every_argument),
    OF.check("driver/describe-of-no-driver", describe_of_none),
    OF.check("driver/open-of-no-driver", open_of_none),
    OF.check("driver/opens", |subject| opened(subject).map(drop)),
    OF.check("driver/opens-again", opens_again),
    OF.check("driver/opens-beside-itself", opens_beside),
    OF.check("driver/rubbish-arguments", rubbish_arguments),
    OF.check("driver/keeps-to-the-callers-error", keeps_to_error),
    OF.check("driver/unknown-extension", unknown_extension),
    OF.check("driver/interrupt-of-nothing", interrupt_of_nothing),
    OF.check("driver/interrupts-from-all-sides", interrupts),
    OF.check("driver/other-thread", other_thread),
    OF.check("driver/discovers", discovers),
    OF.check("driver/memory-of-10000-openings", memory),
];

/// Open device of any kind. A check keeps the device only to close it.
enum Device {
    Sensor(Opened<abi::SensorCalls>),
    Robot(Opened<abi::RobotCalls>),
    Force(Opened<abi::ForceCalls>),
    Lighting(Opened<abi::LightingCalls>),
    Changer(Opened<abi::ChangerCalls>),
}

impl Device {
    fn handle(&self) -> &taceva_host::bare::Owned {
        match self {
            Device::Sensor(opened) => &opened.handle,
            Device::Robot(opened) => &opened.handle,
            Device::Force(opened) => &opened.handle,
            Device::Lighting(opened) => &opened.handle,
            Device::Changer(opened) => &opened.handle,
        }
    }
}

fn opened(subject: &Subject) -> Result<Device, Unmet> {
    match subject.descriptor()?.kind() {
        DriverKind::Sensor => Ok(Device::Sensor(subject.open()?)),
        DriverKind::Robot => Ok(Device::Robot(subject.open()?)),
        DriverKind::Force => Ok(Device::Force(subject.open()?)),
        DriverKind::Lighting => Ok(Device::Lighting(subject.open()?)),
        DriverKind::Changer => Ok(Device::Changer(subject.open()?)),
        kind => Err(Unmet::Skipped(format!(
            "this program does not know the kind of device {kind}"
        ))),
    }
}

fn factory(subject: &Subject) -> Result<abi::Factory, Unmet> {
    let factory = subject.entry()?.factory;
    factory.ok_or_else(|| broken("it has no factory"))
}

fn describes_twice(subject: &Subject) -> Result<(), Unmet> {
    let [once, again] = [subject.said()?, subject.said()?];
    expect(once == again, || {
        "the second description of itself differs from the first".to_owned()
    })
}

/// With each argument at its least and greatest value, the driver returns its description, or rejects the combination of arguments.
fn describes_every_argument(subject: &Subject) -> Result<(), Unmet> {
    let key = subject.key()?;
    for spec in subject.entry()?.arguments() {
        let values: Vec<ArgValue> = match &spec.kind {
            ArgKind::Whole { least, most } => vec![ArgValue::Whole(*least), ArgValue::Whole(*most)],
            ArgKind::Number { least, most } => [least, most]
                .into_iter()
                .filter(|limit| limit.is_finite())
                .map(|limit| ArgValue::Number(*limit))
                .collect(),
            ArgKind::Flag => vec![ArgValue::Flag(false), ArgValue::Flag(true)],
            ArgKind::Choice { of } => of.iter().cloned().map(ArgValue::Text).collect(),
            _ => continue,
        };
        for value in values {
            let value = value.to_string();
            let given = subject.args()?;
            let others = subject
                .entry()?
                .arguments()
                .iter()
                .filter(|other| other.key != spec.key);
            let others = others
                .filter_map(|other| Some((other.key.clone(), given.get(&other.key)?.to_string())));
            let pairs = others.chain([(spec.key.clone(), value.clone())]);
            let args = Args::from_pairs(subject.entry()?.arguments(), pairs)
                .map_err(|error| Unmet::Broken(error.to_string()))?;
            match subject.session.describe(key, &args) {
                Err(error) if error.kind() != ErrorKind::InvalidArgument => {
                    let why = format!("with `{}={value}`: {error}", spec.key);
                    return Err(Unmet::Broken(why));
                }
                _ => {}
            }
        }
    }
    Ok(())
}

fn describe_of_none(subject: &Subject) -> Result<(), Unmet> {
    let factory = factory(subject)?;
    let describe = factory
        .describe
        .ok_or_else(|| broken("`describe` is NULL"))?;
    let list = ArgList::new(&Args::default(), &[]);
    let args = list.args();
    for number in [factory.drivers, factory.drivers + 1, u32::MAX] {
        let mut taken = Taken::default();
        let context = taken.context();
        // SAFETY: [any], with arguments, a context and an error that outlive the call.
        let said =
            bare(|error| unsafe { describe(number, &raw const args, Some(take), context, error) });
        let kinds = [
            ErrorKind::NotFound,
            ErrorKind::InvalidArgument,
            ErrorKind::OutOfRange,
        ];
        refused(&format!("describing driver {number}"), said, &kinds)?;
    }
    Ok(())
}

fn raw_open(
    subject: &Subject,
    number: u32,
    args: &abi::Args,
    error: *mut abi::Error,
) -> Result<(abi::Status, abi::Device), Unmet> {
    let open = factory(subject)?.open;
    let open = open.ok_or_else(|| broken("`open` is NULL"))?;
    let rig = taceva_host::bare::RigHandle::open(&subject.library)?;
    let mut device = abi::Device {
        handle: std::ptr::null_mut(),
        calls: std::ptr::null(),
    };
    let opening = pending_call::begin(OPENING);
    // SAFETY: [any], with arguments, a rig, a place for the device and an error that outlive the call.
    let status = unsafe {
        open(
            number,
            std::ptr::from_ref(args),
            rig.raw(),
            &raw mut device,
            error,
        )
    };
    drop(opening);
    if status.is_ok() && !device.calls.is_null() {
        // SAFETY: after a success, the interface specifies the table, which outlives the device.
        if let Some(close) = unsafe { (*device.calls).close } {
            // SAFETY: [owner & open], the last call; the rig is still open.
            unsafe { close(device.handle) };
        }
    }
    Ok((status, device))
}

fn open_of_none(subject: &Subject) -> Result<(), Unmet> {
    let list = subject.list()?;
    let drivers = factory(subject)?.drivers;
    for number in [drivers, drivers + 1, u32::MAX] {
        let mut error = abi::Error::new();
        let (status, _) = raw_open(subject, number, &list.args(), &raw mut error)?;
        expect(!status.is_ok(), || {
            format!("driver {number} opened, but the plugin has no such driver")
        })?;
    }
    Ok(())
}

fn opens_again(subject: &Subject) -> Result<(), Unmet> {
    for _ in 0..subject.openings(10) {
        drop(opened(subject)?);
    }
    Ok(())
}

/// A second device with the same arguments either opens or returns `BUSY`.
fn opens_beside(subject: &Subject) -> Result<(), Unmet> {
    let first = opened(subject)?;
    let list = subject.list()?;
    let mut error = abi::Error::new();
    let (status, _) = raw_open(
        subject,
        subject.entry()?.number,
        &list.args(),
        &raw mut error,
    )?;
    drop(first);
    expect(status.is_ok() || status == abi::Status::BUSY, || {
        format!(
            "a second device gave status {}, expected 0 or BUSY",
            status.0
        )
    })?;
    opened(subject).map(drop)
}

/// The plugin returns from a call that opens a device with an undeclared argument of random content.
fn rubbish_arguments(subject: &Subject) -> Result<(), Unmet> {
    let mut draw = Draw::new(subject.probe.seed);
    for round in 0..subject.openings(64) {
        let bytes = [draw.bytes(1 + round), draw.bytes(round)];
        let [key, text] = bytes.each_ref().map(|bytes| abi::Text {
            data: bytes.as_ptr().cast(),
            length: bytes.len(),
        });
        let number = f64::from_bits(draw.next());
        let kind = u32::from(draw.next().to_le_bytes()[0] % 8);
        let arg = abi::Arg {
            key,
            text,
            whole: draw.next().cast_signed(),
            number,
            kind,
            reserved: 0,
        };
        let args = abi::Args {
            items: &raw const arg,
            count: 1,
        };
        let mut error = abi::Error::new();
        // Any result passes, but the call must return.
        raw_open(subject, subject.entry()?.number, &args, &raw mut error)?;
    }
    Ok(())
}

/// A plugin writes to a `taceva_error` only within the size that the error states.
fn keeps_to_error(subject: &Subject) -> Result<(), Unmet> {
    const ROOM: usize = 24;
    const CANARY: i8 = 0x5a;
    let mut error = abi::Error::new();
    let begin = offset_of!(abi::Error, message);
    error.size = u32::try_from(begin + ROOM).expect("small");
    error.message = [CANARY; abi::MESSAGE_SIZE];
    let list = subject.list()?;
    let drivers = factory(subject)?.drivers;
    let (status, _) = raw_open(subject, drivers, &list.args(), &raw mut error)?;
    expect(!status.is_ok(), || {
        "a driver with an unknown number opened".to_owned()
    })?;
    let written = error.message[ROOM..].iter().any(|byte| *byte != CANARY);
    expect(!written, || {
        format!("a message exceeded the {ROOM} bytes of its `taceva_error`")
    })?;
    // A host of minor version 0 has no space for a fault.
    const NONE: abi::FaultNumber = abi::FaultNumber(0x5a5a);
    let mut error = abi::Error::new();
    error.size = u32::try_from(offset_of!(abi::Error, fault)).expect("small");
    error.fault = NONE;
    raw_open(subject, drivers, &list.args(), &raw mut error)?;
    expect(error.fault == NONE, || {
        "a fault was written beyond the end of a `taceva_error`".to_owned()
    })
}

fn unknown_extension(subject: &Subject) -> Result<(), Unmet> {
    let device = opened(subject)?;
    for id in ["", "taceva.nothing/1", "taceva.force.tare/99"] {
        let found = device.handle().extension_is_there(id);
        expect(!found, || {
            format!("a table for the unknown extension {id:?}")
        })?;
    }
    Ok(())
}

fn interrupt_of_nothing(subject: &Subject) -> Result<(), Unmet> {
    let device = opened(subject)?;
    let Some(interrupt) = device.handle().interrupt() else {
        return Err(skipped("it cannot be interrupted"));
    };
    for _ in 0..100 {
        interrupt.interrupt();
    }
    drop(device);
    interrupt.interrupt();
    Ok(())
}

fn interrupts(subject: &Subject) -> Result<(), Unmet> {
    let device = opened(subject)?;
    let Some(interrupt) = device.handle().interrupt() else {
        return Err(skipped("it cannot be interrupted"));
    };
    let interrupt = &interrupt;
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(move || {
                for _ in 0..2_500 {
                    interrupt.interrupt();
                }
            });
        }
    });
    drop(device);
    opened(subject).map(drop)
}

/// A device that one thread opened can be closed by another thread.
fn other_thread(subject: &Subject) -> Result<(), Unmet> {
    let device = opened(subject)?;
    let closed = thread::scope(|scope| scope.spawn(move || drop(device)).join());
    expect(closed.is_ok(), || {
        "closing it in another thread panicked".to_owned()
    })
}

fn discovers(subject: &Subject) -> Result<(), Unmet> {
    let found = subject.session.discover(subject.key()?)?;
    for device in &found {
        let read = subject.descriptor()?.args(&device.arguments);
        read.map_err(|error| {
            Unmet::Broken(format!(
                "it found `{}`, but rejects these arguments: {error}",
                device.arguments
            ))
        })?;
    }
    Ok(())
}

/// The first 100 openings of a device may allocate. Another 9,900 add less than 1 MiB to the writable memory of the process.
fn memory(subject: &Subject) -> Result<(), Unmet> {
    if subject.is_real() {
        let why = "the check would open a real device 10000 times";
        return Err(Unmet::Skipped(why.to_owned()));
    }
    for _ in 0..100 {
        drop(opened(subject)?);
    }
    let before = writable_memory()?;
    for _ in 0..9_900 {
        drop(opened(subject)?);
    }
    let grown = writable_memory()?.saturating_sub(before);
    expect(grown < 1 << 20, || {
        format!(
            "9900 openings leaked {} KiB, expected less than 1024",
            grown >> 10
        )
    })
}
