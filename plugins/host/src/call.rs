//! What every call across the line needs: statuses read, messages kept, text taken, tables copied.

#![expect(
    unsafe_code,
    reason = "text and tables of a plugin are read through its pointers"
)]

use std::ffi::c_void;
use std::fmt;
use std::mem::MaybeUninit;

use taceva_abi as abi;
use taceva_core::{ArgSpec, ArgValue, Args, Deadline, DriverError, DriverKey, ErrorKind};

use crate::shown::shown;

/// A call that failed, in the plugin's words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    kind: ErrorKind,
    message: String,
}

impl Failure {
    /// A failure that the host noticed.
    pub(crate) fn new(kind: ErrorKind, message: impl Into<String>) -> Failure {
        Failure {
            kind,
            message: message.into(),
        }
    }

    /// What kind of failure it was.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The same, as the failure of `driver` while it was `doing`.
    pub(crate) fn of(self, driver: &DriverKey, doing: &'static str) -> DriverError {
        DriverError::new(self.kind, driver, doing).because(self.message)
    }

    pub(crate) fn message(self) -> String {
        self.message
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

/// Makes a call with an empty error and reads how it ended.
pub(crate) fn call(run: impl FnOnce(&mut abi::Error) -> abi::Status) -> Result<(), Failure> {
    let mut error = abi::Error::new();
    let status = run(&mut error);
    if status.is_ok() {
        return Ok(());
    }
    let position = usize::try_from(-i64::from(status.0)).unwrap_or(0);
    let known = position
        .checked_sub(1)
        .and_then(|at| ErrorKind::ALL.get(at));
    let Some(&kind) = known else {
        let message = format!("status {}, which is none of the interface's", status.0);
        return Err(Failure::new(ErrorKind::Abi, message));
    };
    let bytes: Vec<u8> = error.bytes().collect();
    let mut message = match bytes.as_slice() {
        [] => kind.to_string(),
        bytes => shown(&String::from_utf8_lossy(bytes)),
    };
    if error.vendor_code != 0 {
        message.push_str(&format!(" (code {} of the device)", error.vendor_code));
    }
    Err(Failure { kind, message })
}

/// The deadline in the interface's unit.
pub(crate) fn timeout(deadline: Deadline) -> u64 {
    u64::try_from(deadline.remaining().as_nanos()).unwrap_or(u64::MAX)
}

/// What a plugin lists: one text a call.
#[derive(Debug, Default)]
pub(crate) struct Taken {
    texts: Vec<String>,
    bytes: usize,
    fault: Option<&'static str>,
}

/// No plugin lists more.
const TEXTS_MAX: usize = 4_096;
/// Nor more bytes.
const BYTES_MAX: usize = 1 << 20;

impl Taken {
    /// What [`take`] is called with.
    pub(crate) fn context(&mut self) -> *mut c_void {
        std::ptr::from_mut(self).cast()
    }

    /// The texts, unless one of them was none.
    pub(crate) fn texts(self) -> Result<Vec<String>, Failure> {
        match self.fault {
            None => Ok(self.texts),
            Some(fault) => Err(Failure::new(ErrorKind::Abi, fault)),
        }
    }

    /// All texts as one.
    pub(crate) fn whole(self) -> Result<String, Failure> {
        Ok(self.texts()?.concat())
    }

    fn add(&mut self, text: abi::Text) {
        self.bytes = self.bytes.saturating_add(text.length);
        if text.data.is_null() && text.length > 0 {
            self.fault = Some("a text without bytes that has a length");
        } else if self.bytes > BYTES_MAX || self.texts.len() >= TEXTS_MAX {
            self.fault = Some("more text than anybody could mean");
        }
        if self.fault.is_some() {
            return;
        }
        // SAFETY: not NULL above a length of 0, and borrowed for this call by the rule of `taceva_take_text`; a length beyond what is
        // mapped is a breach of the plugin's promise, and no length above 1 MiB is believed.
        match unsafe { text.to_str() } {
            Ok(text) => self.texts.push(text.to_owned()),
            Err(_) => self.fault = Some("a text that is not UTF-8"),
        }
    }
}

/// Takes one text into the [`Taken`] that `context` is.
pub(crate) unsafe extern "C" fn take(context: *mut c_void, text: abi::Text) {
    // SAFETY: `context` is what `Taken::context` gave for the call that is under way, and nobody else looks at it meanwhile.
    let taken = unsafe { &mut *context.cast::<Taken>() };
    taken.add(text);
}

/// Arguments in the interface's form; they borrow from the texts kept beside them.
pub(crate) struct ArgList {
    items: Vec<abi::Arg>,
    // What the items point to, on the heap: moving the list moves none of it.
    _texts: Vec<(String, String)>,
}

impl ArgList {
    /// The arguments that `args` holds, out of those that `specs` declare.
    pub(crate) fn new(args: &Args, specs: &[ArgSpec]) -> ArgList {
        let given = specs
            .iter()
            .filter_map(|spec| Some((spec, args.get(&spec.key)?)));
        let (mut items, mut texts) = (Vec::new(), Vec::new());
        for (spec, value) in given {
            texts.push((spec.key.clone(), value.to_string()));
            let (key, text) = texts.last().expect("it was pushed");
            let (kind, whole, number) = match *value {
                ArgValue::Text(_) => (abi::Arg::TEXT, 0, 0.0),
                ArgValue::Whole(whole) => (abi::Arg::WHOLE, whole, 0.0),
                ArgValue::Number(number) => (abi::Arg::NUMBER, 0, number),
                ArgValue::Flag(flag) => (abi::Arg::FLAG, i64::from(flag), 0.0),
            };
            items.push(abi::Arg {
                key: abi::Text::from(key),
                text: abi::Text::from(text),
                whole,
                number,
                kind,
                reserved: 0,
            });
        }
        ArgList {
            items,
            _texts: texts,
        }
    }

    /// What is handed over; it borrows from the list.
    pub(crate) fn args(&self) -> abi::Args {
        abi::Args {
            items: self.items.as_ptr(),
            count: self.items.len(),
        }
    }
}

/// A table of functions that begins with its size.
///
/// # Safety
/// The type is `repr(C)`, begins with its size as a `u32`, and is a value where all its bytes are 0.
pub(crate) unsafe trait Table: Copy {
    /// Its name, for messages.
    const NAME: &'static str;
}

macro_rules! tables {
    ($($table:ty => $name:literal),* $(,)?) => {$(
        // SAFETY: it is `repr(C)`, begins with `size: u32`, and holds numbers and optional functions alone.
        unsafe impl Table for $table {
            const NAME: &'static str = $name;
        }
    )*};
}

tables! {
    abi::Factory => "taceva_factory",
    abi::EstimatorFactory => "taceva_estimator_factory",
    abi::SensorCalls => "taceva_sensor_calls",
    abi::RobotCalls => "taceva_robot_calls",
    abi::ForceCalls => "taceva_force_calls",
    abi::LightingCalls => "taceva_lighting_calls",
    abi::RegressorCalls => "taceva_regressor_calls",
    abi::ext::TareCalls => "taceva_tare_calls",
    abi::ext::GuardedMotionCalls => "taceva_guarded_motion_calls",
    abi::ext::SensorLightingCalls => "taceva_sensor_lighting_calls",
    abi::ext::BenchCalls => "taceva_bench_calls",
}

/// A copy of the table at `table`: fields beyond the plugin's own size are NULL.
///
/// # Safety
/// `table` points to a table as the interface has it: at least its size field can be read, and as many bytes as that says.
pub(crate) unsafe fn table<T: Table>(table: *const c_void) -> Result<T, Failure> {
    let refused = |problem: &str| Failure::new(ErrorKind::Abi, format!("{}: {problem}", T::NAME));
    if table.is_null() {
        return Err(refused("the table is NULL"));
    }
    if !table.addr().is_multiple_of(align_of::<T>()) {
        return Err(refused("the table is misaligned"));
    }
    // SAFETY: not NULL, aligned, and begins with its size by the caller's promise.
    let size = unsafe { table.cast::<u32>().read() };
    let size = usize::try_from(size).unwrap_or(usize::MAX);
    if size < size_of::<u64>() {
        return Err(refused("a size that does not even cover the size"));
    }
    let mut copy = MaybeUninit::<T>::zeroed();
    let known = size.min(size_of::<T>());
    // SAFETY: `known` bytes can be read, since the plugin's table has as many, and written, since ours has as many.
    unsafe {
        std::ptr::copy_nonoverlapping(table.cast::<u8>(), copy.as_mut_ptr().cast::<u8>(), known);
    }
    // SAFETY: whatever was not copied is 0, which is a value of every `Table`.
    Ok(unsafe { copy.assume_init() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_is_the_kind_of_its_number_and_no_other_number_is_one() {
        for kind in ErrorKind::ALL {
            let number = i32::try_from(kind as u32).expect("small");
            let failure = call(|_| abi::Status(-number)).expect_err("failed");
            assert_eq!(
                (failure.kind(), failure.to_string()),
                (kind, kind.to_string())
            );
        }
        for status in [1, 16, -16, i32::MIN, i32::MAX] {
            let failure = call(|_| abi::Status(status)).expect_err("failed");
            assert_eq!(failure.kind(), ErrorKind::Abi, "{status}");
        }
    }

    #[test]
    fn a_message_is_made_harmless_and_carries_the_devices_own_number() {
        let failure = call(|error| {
            error.write("no\u{1b}[2J answer");
            error.vendor_code = 31;
            abi::Status::TIMEOUT
        });
        let message = failure.expect_err("failed").to_string();
        assert_eq!(message, "no\\u{1b}[2J answer (code 31 of the device)");
        let all = call(|error| {
            error.message.fill(-1);
            abi::Status::TIMEOUT
        });
        assert!(all.expect_err("failed").to_string().starts_with('\u{fffd}'));
    }

    #[test]
    fn text_that_is_none_is_a_fault_and_nothing_of_it_is_read() {
        let taken = |texts: &[abi::Text]| {
            let mut taken = Taken::default();
            for text in texts {
                // SAFETY: the context is that of `taken`, and each text is as long as it says or refused by its length.
                unsafe { take(taken.context(), *text) };
            }
            taken.whole()
        };
        assert_eq!(
            taken(&[abi::Text::from("a"), abi::Text::from("b")]),
            Ok("ab".to_owned())
        );
        let nothing = abi::Text {
            data: std::ptr::null(),
            length: 5,
        };
        let endless = abi::Text {
            data: c"x".as_ptr(),
            length: usize::MAX,
        };
        let odd = abi::Text {
            data: c"\xff\xfe".as_ptr(),
            length: 2,
        };
        for text in [nothing, endless, odd] {
            assert!(taken(&[text]).is_err());
            assert!(taken(&[abi::Text::from("a"), text]).is_err());
        }
    }

    #[test]
    fn a_shorter_table_ends_in_functions_that_are_absent() {
        let mut calls: abi::ForceCalls = {
            // SAFETY: all bytes 0 is a table without functions.
            unsafe { MaybeUninit::zeroed().assume_init() }
        };
        unsafe extern "C" fn close(_: *mut c_void) {}
        calls.device.close = Some(close);
        let copy = |size: u32, calls: &mut abi::ForceCalls| {
            calls.device.size = size;
            // SAFETY: it is a table, and never says more than it has.
            unsafe { table::<abi::ForceCalls>(std::ptr::from_ref(calls).cast()) }
        };
        assert!(copy(16, &mut calls).expect("read").device.close.is_some());
        assert!(copy(8, &mut calls).expect("read").device.close.is_none());
        assert!(copy(4, &mut calls).is_err());
        // SAFETY: NULL and what is misaligned is refused unread.
        assert!(unsafe { table::<abi::ForceCalls>(std::ptr::null()) }.is_err());
        let odd = std::ptr::from_ref(&calls).cast::<u8>().wrapping_add(1);
        // SAFETY: as above.
        assert!(unsafe { table::<abi::ForceCalls>(odd.cast()) }.is_err());
    }
}
