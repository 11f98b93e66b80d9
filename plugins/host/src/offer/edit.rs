//! Update of a manifest's text from the data that its library states. Comments and order are kept.

use toml::Value as Plain;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, Value, value};

use super::Offer;
use crate::descriptor::{arguments, difference};
use crate::manifest::{LibraryFile, Manifest, ManifestError, Provided, platform};
use crate::wire_version::WIRE;

/// Keys that manifests have but libraries do not state.
const OF_MANIFEST: [&str; 1] = ["usb"];

impl Offer {
    /// Updates the manifest `text` to this offer of `library`. If `text` is empty, writes a new manifest with the licence `license`.
    ///
    /// Keeps comments and the key `usb`, which libraries do not state. Keeps `needs` if the library states none.
    ///
    /// # Errors
    /// [`ManifestError`] if `text` is not TOML, the offer does not fit a manifest, or a new manifest lacks a licence.
    pub fn manifest(
        &self,
        text: &str,
        library: &LibraryFile,
        license: Option<&str>,
    ) -> Result<String, ManifestError> {
        self.written(text, license, false, |manifest| {
            library_of(manifest, library)
        })
    }

    /// As [`manifest`](Offer::manifest), for the offer of a Python `module`. Keeps the preloaded modules and the profile.
    ///
    /// # Errors
    /// As [`manifest`](Offer::manifest).
    pub fn manifest_of_module(
        &self,
        text: &str,
        module: &str,
        license: Option<&str>,
    ) -> Result<String, ManifestError> {
        self.written(text, license, true, |manifest| module_of(manifest, module))
    }

    fn written(
        &self,
        text: &str,
        license: Option<&str>,
        is_module: bool,
        code: impl FnOnce(&mut DocumentMut),
    ) -> Result<String, ManifestError> {
        let wrong = |error: toml_edit::TomlError| {
            ManifestError::whole(error.to_string().trim_end().replace('\n', "; "))
        };
        let mut manifest: DocumentMut = text.parse().map_err(wrong)?;
        self.head(&mut manifest, license, is_module)?;
        if !self.needs.is_empty() {
            needs(&mut manifest, &self.needs);
        }
        code(&mut manifest);
        let offered: Result<Vec<Table>, ManifestError> = self
            .provides
            .iter()
            .map(|table| table.parse::<DocumentMut>().map_err(wrong))
            .map(|table| table.map(|table| table.as_table().clone()))
            .collect();
        provides(&mut manifest, offered?);
        let written = manifest.to_string();
        self.check(&written)?;
        Ok(written)
    }

    fn head(
        &self,
        manifest: &mut DocumentMut,
        license: Option<&str>,
        is_module: bool,
    ) -> Result<(), ManifestError> {
        let is_new = manifest.get("license").is_none();
        let name = self.id.rsplit('.').next().unwrap_or(&self.id);
        let license = match (license, is_new) {
            (Some(license), _) => license,
            (None, false) => "",
            (None, true) => {
                let why = "the key `license` is missing, and a library does not state it; give `--license`";
                return Err(ManifestError::whole(why));
            }
        };
        let mut set = |key: &str, said: Value, always: bool| {
            if always || manifest.get(key).is_none() {
                put(manifest.as_table_mut(), key, &value(said));
            }
        };
        set("manifest_version", 1.into(), false);
        set("id", self.id.as_str().into(), true);
        set("name", name.into(), false);
        set("version", self.version.as_str().into(), true);
        set("license", license.into(), false);
        if manifest.get("abi").is_none() && !is_module {
            let abi = "{ major = 1, minor = 0 }".parse::<Value>();
            let abi = abi.map_err(|error| ManifestError::whole(error.to_string()))?;
            put(manifest.as_table_mut(), "abi", &value(abi));
        }
        Ok(())
    }

    /// Fails if `written` is not a manifest or contradicts the offer.
    fn check(&self, written: &str) -> Result<(), ManifestError> {
        let manifest = Manifest::parse(written)?;
        for table in &self.provides {
            let offered = Provided::parse(table, &manifest.id)?;
            let mut said = manifest.provides.iter();
            let said = said.find(|said| said.key() == offered.key());
            let differs = match (said, &offered) {
                (
                    Some(Provided::Driver { descriptor, .. }),
                    Provided::Driver {
                        descriptor: other, ..
                    },
                ) => difference(descriptor, other),
                (Some(Provided::Estimator(one)), Provided::Estimator(other)) => {
                    arguments([&one.settings, &other.settings])
                }
                _ => Some(["kind".to_owned(), String::new(), String::new()]),
            };
            if let Some([what, ..]) = differs {
                let key = offered.key();
                return Err(ManifestError::whole(format!(
                    "`{key}`, {what}: cannot be edited in its present form; write it by hand:\n[[provides]]\n{}",
                    table.replace("[[args]]", "[[provides.args]]")
                )));
            }
        }
        Ok(())
    }
}

/// Sets `key` unless it already has this value. Keeps comments and spaces around the value.
fn put(table: &mut Table, key: &str, said: &Item) {
    match table.get_mut(key) {
        Some(item) if is_same(item, said) => {}
        Some(Item::Value(old)) => {
            if let Some(new) = said.as_value() {
                let decor = old.decor().clone();
                *old = new.clone();
                *old.decor_mut() = decor;
            }
        }
        Some(item) => *item = said.clone(),
        None => {
            table.insert(key, said.clone());
        }
    }
}

/// True if both values are equal. An integer equals the float of the same value.
fn is_same(one: &Item, other: &Item) -> bool {
    fn plain(item: &Item) -> Option<Plain> {
        let mut table = DocumentMut::new();
        table.insert("it", item.clone());
        let read: toml::Table = toml::from_str(&table.to_string()).ok()?;
        read.get("it").cloned()
    }
    fn same(one: &Plain, other: &Plain) -> bool {
        let number = |value: &Plain| match value {
            Plain::Integer(whole) => Some(*whole as f64),
            Plain::Float(number) => Some(*number),
            _ => None,
        };
        match (one, other) {
            (Plain::Array(one), Plain::Array(other)) => {
                one.len() == other.len()
                    && one.iter().zip(other).all(|(one, other)| same(one, other))
            }
            (Plain::Table(one), Plain::Table(other)) => {
                let has = |(key, value): (&String, &Plain)| {
                    other.get(key).is_some_and(|other| same(value, other))
                };
                one.len() == other.len() && one.iter().all(has)
            }
            _ => match number(one).zip(number(other)) {
                Some((one, other)) => one.total_cmp(&other).is_eq(),
                None => one == other,
            },
        }
    }
    plain(one)
        .zip(plain(other))
        .is_some_and(|(one, other)| same(&one, &other))
}

/// Sets the needs of the library. Existing needs keep their position and comments.
fn needs(manifest: &mut DocumentMut, said: &[String]) {
    match manifest.get_mut("needs").and_then(Item::as_array_mut) {
        Some(written) => {
            written.retain(|need| {
                need.as_str()
                    .is_some_and(|need| said.iter().any(|said| said == need))
            });
            for need in said {
                if !written.iter().any(|written| written.as_str() == Some(need)) {
                    written.push(need.as_str());
                }
            }
        }
        None => {
            let needs: Array = said.iter().map(String::as_str).collect();
            manifest.insert("needs", value(needs));
        }
    }
}

/// Adds the library of this platform if it is missing. Updates the digest of the library if the manifest has a digest.
fn library_of(manifest: &mut DocumentMut, library: &LibraryFile) {
    let platform = platform();
    let tables = manifest
        .entry("library")
        .or_insert_with(|| Item::Table(Table::new()));
    let Some(tables) = tables.as_table_like_mut() else {
        return;
    };
    let Some(written) = tables.get_mut(&platform) else {
        let mut file = toml_edit::InlineTable::new();
        file.insert("path", library.path.as_str().into());
        tables.insert(&platform, value(file));
        return;
    };
    let digest = written
        .as_table_like_mut()
        .and_then(|file| file.get_mut("sha256"));
    if let (Some(Item::Value(written)), Some(digest)) = (digest, library.sha256) {
        let decor = written.decor().clone();
        *written = digest.to_string().into();
        *written.decor_mut() = decor;
    }
}

/// Sets the module and the wire version of this program.
fn module_of(manifest: &mut DocumentMut, module: &str) {
    let program = manifest
        .entry("program")
        .or_insert_with(|| Item::Table(Table::new()));
    let Some(program) = program.as_table_mut() else {
        return;
    };
    put(program, "python", &value(module));
    put(program, "wire", &value(i64::from(WIRE)));
}

/// Sets the tables of drivers and estimators.
fn provides(manifest: &mut DocumentMut, offered: Vec<Table>) {
    let written = manifest
        .get("provides")
        .and_then(Item::as_array_of_tables)
        .cloned();
    let mut written: Vec<Table> = written.into_iter().flatten().collect();
    let mut tables = ArrayOfTables::new();
    // Existing tables keep their order; new ones follow.
    let key = |table: &Table| table.get("key").and_then(Item::as_str).map(str::to_owned);
    let mut offered: Vec<Table> = offered;
    offered.sort_by_key(|table| {
        let place = written
            .iter()
            .position(|written| key(written) == key(table));
        place.unwrap_or(usize::MAX)
    });
    for mut said in offered {
        let place = written
            .iter()
            .position(|written| key(written) == key(&said));
        let arguments = said.remove("args");
        let mut table = match place {
            Some(place) => updated(written.remove(place), &said),
            None => said,
        };
        let arguments = arguments.and_then(|item| item.into_array_of_tables().ok());
        args(&mut table, arguments.into_iter().flatten().collect());
        table.set_position(None);
        tables.push(table);
    }
    manifest.insert("provides", Item::ArrayOfTables(tables));
}

fn args(table: &mut Table, offered: Vec<Table>) {
    let written = table
        .remove("args")
        .and_then(|item| item.into_array_of_tables().ok());
    let mut written: Vec<Table> = written.into_iter().flatten().collect();
    let mut tables = ArrayOfTables::new();
    let key = |table: &Table| table.get("key").and_then(Item::as_str).map(str::to_owned);
    for said in offered {
        let place = written
            .iter()
            .position(|written| key(written) == key(&said));
        let mut argument = match place {
            Some(place) => updated(written.remove(place), &said),
            None => said,
        };
        argument.set_position(None);
        tables.push(argument);
    }
    if !tables.is_empty() {
        table.insert("args", Item::ArrayOfTables(tables));
    }
}

/// Updates the table `written` to `said`, keeping keys that only a manifest has.
fn updated(mut written: Table, said: &Table) -> Table {
    let is_left = |key: &str| said.contains_key(key) || OF_MANIFEST.contains(&key) || key == "args";
    written.retain(|key, _| is_left(key));
    for (key, item) in said {
        if !(OF_MANIFEST.contains(&key) && written.contains_key(key)) {
            put(&mut written, key, item);
        }
    }
    // The library's key order, so a manifest that it wrote stays unchanged.
    let own = said.iter().map(|(key, _)| key.to_owned());
    let left = written.iter().map(|(key, _)| key.to_owned());
    let left = left.filter(|key| !said.contains_key(key));
    let order: Vec<String> = own.chain(left.collect::<Vec<_>>()).collect();
    for key in order {
        if let Some((key, item)) = written.remove_entry(&key) {
            written.insert_formatted(&key, item);
        }
    }
    written
}

#[cfg(test)]
mod tests;
