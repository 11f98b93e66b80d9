//! Files of a new plugin.

use crate::kind::Kind;
use crate::name::Name;

/// Sources of the crates for Rust plugins: paths such as `taceva-core/src/lib.rs`, and their texts.
const SOURCES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// Manifests of the crates for Rust plugins, without inheritance from a workspace.
const MANIFESTS: [(&str, &str); 3] = [
    (
        "taceva-core",
        include_str!("../vendor/taceva-core/Cargo.toml.in"),
    ),
    (
        "taceva-abi",
        include_str!("../vendor/taceva-abi/Cargo.toml.in"),
    ),
    (
        "taceva-plugin",
        include_str!("../vendor/taceva-plugin/Cargo.toml.in"),
    ),
];

/// Headers for C and C++ plugins: paths such as `include/taceva/plugin.h`, and their texts.
const HEADERS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/headers.rs"));

/// Version of this program and of the embedded crates.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Source of the crates for a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sources {
    /// Crates embedded in this program, under `vendor/`. The plugin builds without a network, for the interface of this program.
    Vendored,
    /// Crates from the registry, by version.
    Registry,
}

/// File of a project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Path below the folder of the project, with `/` as separator.
    pub path: String,
    /// Content of the file.
    pub text: String,
}

/// Files of a new plugin with one driver of `kind`.
pub fn project(kind: Kind, name: &Name, sources: Sources) -> Vec<File> {
    let of_kind = kind.files();
    let fill = |text: &str| {
        text.replace("@introduction@", kind.introduction())
            .replace("@use@", kind.usage())
            .replace("@name@", name.as_str())
            .replace("@crate@", &name.as_crate())
            .replace("@kind@.rs", &format!("{}.rs", kind.name()))
            .replace("@A kind@", &kind.noun_with_article())
            .replace("@kind@", kind.noun())
            .replace("@dependencies@", dependencies(sources))
            .replace("@version@", VERSION)
    };
    let file = |path: &str, text: &str| File {
        path: path.to_owned(),
        text: fill(text),
    };
    let manifest = [include_str!("../project/plugin.toml.in"), of_kind.provides].concat();
    let mut files = vec![
        file("Cargo.toml", include_str!("../project/Cargo.toml.in")),
        file("README.md", include_str!("../project/README.md.in")),
        file(".gitignore", include_str!("../project/gitignore.in")),
        file("plugin.toml", &manifest),
        file("src/lib.rs", of_kind.library),
        file(&format!("src/{kind}.rs"), of_kind.driver),
    ];
    if sources == Sources::Vendored {
        files.extend(vendored());
    }
    files
}

/// Headers for C and C++ plugins, below `include/`.
pub fn headers() -> Vec<File> {
    let headers = HEADERS.iter().map(|(path, text)| File {
        path: (*path).to_owned(),
        text: (*text).to_owned(),
    });
    headers.collect()
}

fn dependencies(sources: Sources) -> &'static str {
    match sources {
        Sources::Vendored => {
            "taceva-core = { path = \"vendor/taceva-core\" }\ntaceva-plugin = { path = \"vendor/taceva-plugin\" }\n"
        }
        Sources::Registry => "taceva-core = \"@version@\"\ntaceva-plugin = \"@version@\"\n",
    }
}

fn vendored() -> impl Iterator<Item = File> {
    let manifests = MANIFESTS.iter().map(|(name, text)| File {
        path: format!("vendor/{name}/Cargo.toml"),
        text: text.replace("@version@", VERSION),
    });
    let sources = SOURCES.iter().map(|(path, text)| File {
        path: format!("vendor/{path}"),
        text: (*text).to_owned(),
    });
    manifests.chain(sources)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_to_be_filled_in() {
        let name: Name = "my-device".parse().expect("a name");
        for kind in Kind::ALL {
            for sources in [Sources::Vendored, Sources::Registry] {
                for file in project(kind, &name, sources) {
                    let is_foreign = file.path.starts_with("vendor/");
                    assert!(is_foreign || !file.text.contains('@'), "{}", file.path);
                }
            }
        }
    }

    #[test]
    fn what_the_crates_are_made_of_is_embedded_whole() {
        let files: Vec<File> = vendored().collect();
        for path in [
            "vendor/taceva-core/src/lib.rs",
            "vendor/taceva-core/src/driver/robot.rs",
            "vendor/taceva-core/README.md",
            "vendor/taceva-abi/src/ext/bench.rs",
            "vendor/taceva-plugin/src/guard.rs",
            "vendor/taceva-plugin/Cargo.toml",
        ] {
            assert!(files.iter().any(|file| file.path == path), "{path}");
        }
        for path in ["include/taceva/ext/tare.h", "include/taceva/sensor.hpp"] {
            assert!(headers().iter().any(|file| file.path == path), "{path}");
        }
        let manifests = files.iter().filter(|file| file.path.ends_with(".toml"));
        for manifest in manifests {
            assert!(!manifest.text.contains("workspace"), "{}", manifest.path);
        }
    }
}
