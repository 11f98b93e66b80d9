//! Emulated host. Calls the tables like a real host, and stores the results.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::ffi::c_void;
use std::ptr::{null, null_mut};
use std::sync::OnceLock;

use taceva_plugin::abi::{
    Arg, Args, Device, DeviceCalls, Error, EstimatorFactory, Factory, Host, Plugin, Rig, Status,
    Text,
};

unsafe extern "C" {
    /// Export of the library, linked by its symbol.
    safe static taceva_plugin_v1: Plugin;
}

/// Status of a call, with its message.
pub(crate) type Ended = (Status, String);

/// The plugin, initialised once.
pub(crate) fn plugin() -> &'static Plugin {
    static READY: OnceLock<Status> = OnceLock::new();
    let status = *READY.get_or_init(|| init(&raw const HOST.0).0);
    assert_eq!(status, Status::OK);
    &taceva_plugin_v1
}

/// Exported table of the plugin, which may not be initialised.
pub(crate) fn exported() -> &'static Plugin {
    &taceva_plugin_v1
}

pub(crate) fn init(host: *const Host) -> Ended {
    let init = taceva_plugin_v1.init.expect("a function");
    // SAFETY: the host is NULL, too short, or lives as long as the program.
    ended(|error| unsafe { init(host, error) })
}

static HOST: SharedHost = SharedHost(Host {
    #[expect(clippy::cast_possible_truncation, reason = "forty bytes")]
    size: size_of::<Host>() as u32,
    abi_minor: 0,
    context: null_mut(),
    log: None,
    now_ns: Some(now_ns),
});

#[repr(transparent)]
struct SharedHost(Host);

// SAFETY: it is never written.
unsafe impl Sync for SharedHost {}

unsafe extern "C" fn now_ns(_: *mut c_void) -> u64 {
    42
}

/// Makes a call with an error argument. Returns status and message.
pub(crate) fn ended(call: impl FnOnce(*mut Error) -> Status) -> Ended {
    let mut error = Error::new();
    let status = call(&raw mut error);
    let message = String::from_utf8(error.bytes().collect()).expect("messages are UTF-8");
    assert_eq!(status.is_ok(), message.is_empty(), "{status:?}: {message}");
    (status, message)
}

/// Factory of the kind with the id `id`.
pub(crate) fn factory(id: &str) -> &'static Factory {
    let factory = plugin().factory.expect("a function");
    // SAFETY: the text lives for the call; the table lives as long as the plugin.
    unsafe { factory(Text::from(id)).cast::<Factory>().as_ref() }.expect("a table")
}

/// Factory of estimators.
pub(crate) fn estimators() -> &'static EstimatorFactory {
    let id = taceva_plugin::abi::ESTIMATOR_FACTORY;
    let factory = plugin().factory.expect("a function");
    // SAFETY: as above.
    unsafe { factory(Text::from(id)).cast::<EstimatorFactory>().as_ref() }.expect("a table")
}

/// Calls `work` with text arguments from `pairs`.
pub(crate) fn with_args<R>(pairs: &[(&str, &str)], work: impl FnOnce(*const Args) -> R) -> R {
    let items: Vec<Arg> = pairs
        .iter()
        .map(|(key, text)| Arg {
            key: Text::from(key),
            text: Text::from(text),
            whole: 0,
            number: 0.0,
            kind: Arg::TEXT,
            reserved: 0,
        })
        .collect();
    let args = Args {
        items: items.as_ptr(),
        count: items.len(),
    };
    work(&raw const args)
}

/// Appends `text` to the list at `context`.
pub(crate) unsafe extern "C" fn take(context: *mut c_void, text: Text) {
    // SAFETY: the context of every call in these tests is a list, and the text is borrowed for the call.
    unsafe {
        let list = &mut *context.cast::<Vec<String>>();
        list.push(text.to_str().expect("UTF-8").to_owned());
    }
}

/// Collects the texts that a function passes to [`take`].
pub(crate) fn taken(call: impl FnOnce(*mut c_void, *mut Error) -> Status) -> (Ended, Vec<String>) {
    let mut list: Vec<String> = Vec::new();
    let context = (&raw mut list).cast();
    let ended = ended(|error| call(context, error));
    (ended, list)
}

/// An open device that is closed on drop.
pub(crate) struct Open {
    handle: *mut c_void,
    calls: *const DeviceCalls,
}

// SAFETY: the interface allows handles on every thread.
unsafe impl Send for Open {}
// SAFETY: as above.
unsafe impl Sync for Open {}

impl Open {
    /// Opens driver 0 of the kind `id`. The argument `way` selects its behaviour.
    pub(crate) fn new(id: &str, way: &str) -> Open {
        Open::in_rig(id, way, null_mut()).expect("it opens")
    }

    pub(crate) fn in_rig(id: &str, way: &str, rig: *mut Rig) -> Result<Open, Ended> {
        let open = factory(id).open.expect("a function");
        let mut device = Device {
            handle: null_mut(),
            calls: null(),
        };
        let ended = with_args(&[("way", way)], |args| {
            // SAFETY: everything lives for the call.
            ended(|error| unsafe { open(0, args, rig, &raw mut device, error) })
        });
        match ended.0 {
            Status::OK => Ok(Open {
                handle: device.handle,
                calls: device.calls,
            }),
            _ => Err(ended),
        }
    }

    /// First argument of the device's calls.
    pub(crate) fn handle(&self) -> *mut c_void {
        self.handle
    }

    /// Table of calls for the kind of the device.
    pub(crate) fn calls<T>(&self) -> &'static T {
        // SAFETY: a table lives as long as the library, and has at least its stated size.
        unsafe {
            assert_eq!(usize::try_from((*self.calls).size), Ok(size_of::<T>()));
            &*self.calls.cast::<T>()
        }
    }

    /// Table of calls of the extension `id`; `None` if the device lacks it.
    pub(crate) fn extension<T>(&self, id: &str) -> Option<&'static T> {
        // SAFETY: the text lives for the call, and the table lives as long as the library.
        unsafe {
            let extension = (*self.calls).extension.expect("a function");
            extension(self.handle, Text::from(id)).cast::<T>().as_ref()
        }
    }

    pub(crate) fn interrupt(&self) {
        // SAFETY: allowed from any thread while the device is open.
        unsafe { (*self.calls).interrupt.expect("a function")(self.handle) };
    }

    pub(crate) fn close(&self) {
        // SAFETY: closing twice is a mistake that the plugin must survive.
        unsafe { (*self.calls).close.expect("a function")(self.handle) };
    }
}

impl Drop for Open {
    fn drop(&mut self) {
        self.close();
    }
}
