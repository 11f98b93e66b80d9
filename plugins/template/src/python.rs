//! Files of a new Python plugin.

use crate::kind::Kind;
use crate::name::Name;
use crate::project::File;

/// Python module of a plugin of `kind`, and its part of the manifest.
fn module(kind: Kind) -> (&'static str, &'static str) {
    macro_rules! files {
        ($kind:literal) => {
            (
                include_str!(concat!("../project/python/", $kind, "/__init__.py.in")),
                include_str!(concat!("../project/python/", $kind, "/provides.toml.in")),
            )
        };
    }
    match kind {
        Kind::Sensor => files!("sensor"),
        Kind::Robot => files!("robot"),
        Kind::Force => files!("force"),
        Kind::Lighting => files!("lighting"),
        Kind::Changer => files!("changer"),
        Kind::Estimator => files!("estimator"),
    }
}

/// Files of a new Python plugin with one driver of `kind`.
pub fn python_project(kind: Kind, name: &Name) -> Vec<File> {
    let (module, provides) = module(kind);
    let manifest = [include_str!("../project/python/plugin.toml.in"), provides].concat();
    files(kind, name, module, &manifest, "\"taceva\"")
}

/// Files of a new Python estimator with a PyTorch network.
pub fn torch_project(name: &Name) -> Vec<File> {
    let module = include_str!("../project/python/torch/__init__.py.in");
    let manifest = include_str!("../project/python/torch/plugin.toml.in");
    let dependencies = "\"taceva\", \"torch\"";
    files(Kind::Estimator, name, module, manifest, dependencies)
}

/// Files of a package with this module and manifest.
fn files(kind: Kind, name: &Name, module: &str, manifest: &str, dependencies: &str) -> Vec<File> {
    let fill = |text: &str| {
        text.replace("@introduction@", kind.introduction())
            .replace("@use@", kind.usage())
            .replace("@name@", name.as_str())
            .replace("@crate@", &name.as_crate())
            .replace("@A kind@", &kind.noun_with_article())
            .replace("@kind@", kind.noun())
            .replace("@dependencies@", dependencies)
    };
    let package = format!("src/{}", name.as_crate());
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
        (format!("{package}/plugin.toml"), manifest),
    ];
    let files = files.map(|(path, text)| File {
        path,
        text: fill(text),
    });
    files.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::{Sources, project};

    #[test]
    fn a_project_in_python_is_a_package_with_its_manifest_in_it() {
        let name: Name = "my-device".parse().expect("a name");
        let projects = Kind::ALL.map(|kind| python_project(kind, &name));
        for files in projects.into_iter().chain([torch_project(&name)]) {
            let paths: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
            assert!(paths.contains(&"src/my_device/plugin.toml"), "{paths:?}");
            for file in &files {
                for left in ["@name@", "@crate@", "kind@", "@dependencies@"] {
                    assert!(!file.text.contains(left), "{}: {left}", file.path);
                }
            }
        }
    }

    #[test]
    fn the_readme_evaluates_an_estimator_and_lists_a_device() {
        let name: Name = "my-device".parse().expect("a name");
        for kind in Kind::ALL {
            let in_rust = project(kind, &name, Sources::Registry);
            let files = in_rust.into_iter().chain(python_project(kind, &name));
            for readme in files.filter(|file| file.path == "README.md") {
                let evaluates = "taceva evaluate RECORDING --model org.example.my-device/my-device";
                let is_estimator = kind == Kind::Estimator;
                assert_eq!(readme.text.contains(evaluates), is_estimator, "{kind}");
                assert_eq!(
                    readme.text.contains("taceva devices"),
                    !is_estimator,
                    "{kind}"
                );
                assert_eq!(readme.text.contains("a device"), !is_estimator, "{kind}");
            }
        }
    }

    #[test]
    fn the_description_of_a_project_has_an_article_that_fits() {
        let name: Name = "my-device".parse().expect("a name");
        let expected = [
            (Kind::Sensor, "A sensor for TacEva"),
            (Kind::Force, "A force transducer for TacEva"),
            (Kind::Estimator, "An estimator for TacEva"),
        ];
        for (kind, description) in expected {
            let in_rust = project(kind, &name, Sources::Registry);
            let files = in_rust.into_iter().chain(python_project(kind, &name));
            let described = files.filter(|file| file.text.contains(description));
            let paths: Vec<String> = described.map(|file| file.path).collect();
            assert_eq!(
                paths,
                ["README.md", "pyproject.toml", "README.md"],
                "{kind}"
            );
        }
    }
}
