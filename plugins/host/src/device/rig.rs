//! Rig of a plugin: state shared by its devices.

#![expect(
    unsafe_code,
    reason = "a rig is opened and closed through the plugin's functions"
)]

use std::sync::Arc;

use taceva_abi as abi;
use taceva_core::DriverError;

use crate::call::call;
use crate::library::Library;

/// An open rig of a plugin, closed after its last device. NULL if the plugin has no rigs.
pub struct RigHandle {
    rig: *mut abi::Rig,
    /// Dropped after the rig, because the library contains its functions.
    library: Arc<Library>,
}

// SAFETY: the pointer is passed only to functions that the interface allows from any thread, and its last owner closes it once.
unsafe impl Send for RigHandle {}
// SAFETY: as above.
unsafe impl Sync for RigHandle {}

impl RigHandle {
    /// Minor version of the interface that the library was built for.
    pub(crate) fn minor(&self) -> u32 {
        self.library.minor()
    }

    /// Opens a rig of `library`.
    ///
    /// # Errors
    /// [`DriverError`] if the plugin refuses.
    pub fn open(library: &Arc<Library>) -> Result<Arc<RigHandle>, DriverError> {
        let mut rig = std::ptr::null_mut();
        if let Some(open) = library.plugin().open_rig {
            // SAFETY: [any], with a place for the rig and an error that outlive the call.
            call(|error| unsafe { open(&raw mut rig, error) })
                .map_err(|failure| failure.of(&library.id().as_driver(), "open a rig"))?;
        }
        Ok(Arc::new(RigHandle {
            rig,
            library: Arc::clone(library),
        }))
    }

    /// The plugin's rig pointer; NULL if it has no rigs.
    pub fn raw(&self) -> *mut abi::Rig {
        self.rig
    }

    pub(crate) fn library(&self) -> &Arc<Library> {
        &self.library
    }
}

impl Drop for RigHandle {
    fn drop(&mut self) {
        if let Some(close) = self
            .library
            .plugin()
            .close_rig
            .filter(|_| !self.rig.is_null())
        {
            // SAFETY: [owner], once: every device of the rig holds this value, so all are closed.
            unsafe { close(self.rig) };
        }
    }
}
