//! Drivers of enabling switches that a program can open.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use taceva_core::{ArgSpec, Args, DriverError, DriverKey, EnablingSwitch, ErrorKind, inventory};

use crate::open_error::OpenError;
use crate::selector::Selector;

/// Function that opens a switch by its selector.
type Open = Box<dyn Fn(&Selector) -> Result<Arc<dyn EnablingSwitch>, OpenError> + Send + Sync>;

/// Registered driver of enabling switches.
struct Entry {
    title: String,
    arguments: Vec<ArgSpec>,
    open: Open,
}

/// Driver of enabling switches that is linked into the program.
pub(crate) struct LinkedSwitch {
    /// Key of the driver.
    pub(crate) key: DriverKey,
    /// Title of the driver.
    pub(crate) title: &'static str,
    /// Arguments that a selector may have.
    pub(crate) arguments: fn() -> Vec<ArgSpec>,
    /// Opens a switch by its selector.
    pub(crate) open: fn(&Selector) -> Result<Arc<dyn EnablingSwitch>, OpenError>,
}

inventory::collect!(LinkedSwitch);

/// Drivers of enabling switches, by key. Switches measure nothing, so a recording does not list them as devices.
///
/// ```
/// use taceva_drivers::Switches;
/// let switches = Switches::builtin();
/// let refused = switches.check(&"lab/arm".parse()?).unwrap_err();
/// assert!(refused.to_string().contains("is not an enabling switch"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Default)]
pub struct Switches(BTreeMap<String, Entry>);

impl fmt::Debug for Switches {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}

impl Switches {
    /// Drivers of all enabling switches that are linked into the program.
    pub fn builtin() -> Switches {
        let mut switches = Switches::default();
        for linked in inventory::iter::<LinkedSwitch> {
            let (key, arguments) = (linked.key.clone(), (linked.arguments)());
            switches.add(key, linked.title, arguments, linked.open);
        }
        switches
    }

    /// Adds or replaces the driver `key`. `open` opens a switch.
    pub fn add(
        &mut self,
        key: DriverKey,
        title: &str,
        arguments: Vec<ArgSpec>,
        open: impl Fn(&Selector) -> Result<Arc<dyn EnablingSwitch>, OpenError> + Send + Sync + 'static,
    ) {
        let entry = Entry {
            title: title.to_owned(),
            arguments,
            open: Box::new(open),
        };
        self.0.insert(key.as_str().to_owned(), entry);
    }

    /// True if `key` is the driver of an enabling switch.
    pub fn has(&self, key: &str) -> bool {
        self.0.contains_key(key)
    }

    /// Key, title and arguments of every driver, sorted by key.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &str, &[ArgSpec])> {
        let entries = self.0.iter();
        entries.map(|(key, entry)| (key.as_str(), entry.title.as_str(), &entry.arguments[..]))
    }

    /// Checks that `selector` names a switch with valid arguments. Opens nothing.
    ///
    /// # Errors
    /// [`OpenError`] for an unknown switch driver or invalid arguments.
    pub fn check(&self, selector: &Selector) -> Result<(), OpenError> {
        self.entry(selector).map(drop)
    }

    /// Opens the switch that `selector` names.
    ///
    /// # Errors
    /// As [`check`](Switches::check), and for a switch that does not open.
    pub fn open(&self, selector: &Selector) -> Result<Arc<dyn EnablingSwitch>, OpenError> {
        (self.entry(selector)?.open)(selector)
    }

    fn entry(&self, selector: &Selector) -> Result<&Entry, OpenError> {
        let Some(entry) = self.0.get(selector.driver()) else {
            let known: Vec<String> = self.0.keys().map(|key| format!("`{key}`")).collect();
            let expected = match known.as_slice() {
                [] => "but this program was built without enabling switches".to_owned(),
                known => format!("expected {}", known.join(" or ")),
            };
            let why = format!(
                "`{}` is not an enabling switch, {expected}",
                crate::text::shown(selector.driver())
            );
            let key = DriverKey::fixed("taceva/switch");
            let error = DriverError::new(ErrorKind::NotFound, &key, "find the switch");
            return Err(OpenError::Device(error.because(why)));
        };
        let args = Args::parse(&entry.arguments, selector.arguments());
        args.map_err(|source| OpenError::Arguments {
            selector: selector.to_string(),
            source,
        })?;
        Ok(entry)
    }
}
