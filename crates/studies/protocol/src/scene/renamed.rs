//! Keys of scenes that earlier versions called otherwise. They are read for one more version, with a note.

use super::parse::Text;

/// A key that has another name now.
pub(super) struct Renamed {
    /// The tables that hold it, from the outermost.
    tables: &'static [&'static str],
    /// How it was called.
    pub(super) before: &'static str,
    /// How it is called.
    pub(super) now: &'static str,
}

/// Every key that has another name now; the parser reads the old name as an alias.
pub(super) const RENAMED: [Renamed; 1] = [Renamed {
    tables: &["protocol", "gratings"],
    before: "told_by",
    now: "classified_by",
}];

/// A note for each old name that `text` uses; none of a text that is no TOML.
pub(super) fn notes(text: &Text) -> Vec<String> {
    let Ok(scene) = text.read::<toml::Table>() else {
        return Vec::new();
    };
    let used = RENAMED.iter().filter(|key| {
        let mut tables = key.tables.iter();
        let table = tables.try_fold(&scene, |table, name| table.get(*name)?.as_table());
        table.is_some_and(|table| table.contains_key(key.before))
    });
    used.map(|Renamed { before, now, .. }| {
        text.note(&format!(
            "`{before}` is called `{now}` now; the next version will not read the old name"
        ))
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;

    const SCENE: &str = "scene_version = 1\nname = \"gel\"\nsensor = { driver = \"sim/gelsight\" }\n\
                         robot = { driver = \"sim/robot\" }\nforce = { driver = \"sim/force-transducer\" }\n\
                         [protocol.gratings]\n";

    #[test]
    fn an_old_name_is_read_with_a_note_and_refused_beside_the_new_one() {
        let parse = |keys: &str| Scene::parse("s.toml", &format!("{SCENE}{keys}"));
        let old = parse("told_by = \"cnn\"").expect("still read");
        let new = parse("classified_by = \"cnn\"").expect("read");
        assert_eq!(old.protocol, new.protocol);
        assert!(new.notes.is_empty(), "{:?}", new.notes);
        assert_eq!(
            old.notes,
            [
                "s.toml: `told_by` is called `classified_by` now; the next version will not read the old name"
            ]
        );
        let both = parse("told_by = \"cnn\"\nclassified_by = \"cnn\"").expect_err("one of them");
        let both = both.to_string();
        assert!(both.contains("`told_by` and `classified_by`"), "{both}");
        let unknown = parse("toldby = \"cnn\"").expect_err("unknown").to_string();
        assert!(!unknown.contains("`told_by`"), "{unknown}");
    }
}
