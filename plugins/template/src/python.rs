//! A new plugin in Python as files.

use crate::kind::Kind;
use crate::name::Name;
use crate::project::File;

/// The module and what its manifest says, of the kinds that can be written in Python.
fn module(kind: Kind) -> Option<(&'static str, &'static str)> {
    macro_rules! files {
        ($kind:literal) => {
            Some((
                include_str!(concat!("../project/python/", $kind, "/__init__.py.in")),
                include_str!(concat!("../project/python/", $kind, "/provides.toml.in")),
            ))
        };
    }
    match kind {
        Kind::Sensor => files!("sensor"),
        Kind::Force => files!("force"),
        Kind::Lighting => files!("lighting"),
        Kind::Estimator => files!("estimator"),
        Kind::Robot | Kind::Changer => None,
    }
}

/// The files of a new plugin in Python with one driver of `kind`; `None` of a kind that cannot be written in Python yet.
pub fn python_project(kind: Kind, name: &Name) -> Option<Vec<File>> {
    let (module, provides) = module(kind)?;
    let fill = |text: &str| {
        text.replace("@name@", name.as_str())
            .replace("@crate@", &name.as_crate())
            .replace("@kind@", kind.noun())
    };
    let package = format!("src/{}", name.as_crate());
    let manifest = [include_str!("../project/python/plugin.toml.in"), provides].concat();
    let files = [
        (
            "pyproject.toml".to_owned(),
            include_str!("../project/python/pyproject.toml.in"),
        ),
        (
            "README.md".to_owned(),
            include_str!("../project/python/README.md.in"),
        ),
        (
            ".gitignore".to_owned(),
            include_str!("../project/python/gitignore.in"),
        ),
        (format!("{package}/__init__.py"), module),
        (format!("{package}/plugin.toml"), manifest.as_str()),
    ];
    let files = files.map(|(path, text)| File {
        path,
        text: fill(text),
    });
    Some(files.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_project_in_python_is_a_package_with_its_manifest_in_it() {
        let name: Name = "my-device".parse().expect("a name");
        let kinds = Kind::ALL
            .into_iter()
            .filter_map(|kind| python_project(kind, &name));
        let kinds: Vec<Vec<File>> = kinds.collect();
        assert_eq!(kinds.len(), 4);
        for files in kinds {
            let paths: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
            assert!(paths.contains(&"src/my_device/plugin.toml"), "{paths:?}");
            for file in &files {
                for left in ["@name@", "@crate@", "@kind@"] {
                    assert!(!file.text.contains(left), "{}: {left}", file.path);
                }
            }
        }
    }
}
