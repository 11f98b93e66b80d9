use super::*;

fn offer() -> Offer {
    Offer {
            id: "org.example.scale".to_owned(),
            version: "0.2.0".to_owned(),
            needs: vec!["hid".to_owned(), "tcp:{host}:502".to_owned()],
            provides: vec![
                "kind = \"force\"\nkey = \"scale\"\ntitle = \"scale\"\nsource = \"real\"\naxes = [\"Fz\"]\nrate_hz = 10.0\ntare = false\n\n[[args]]\nkey = \"host\"\ntype = \"text\"\n\n[[args]]\nkey = \"unit\"\ntype = \"choice\"\nchoices = [\"g\", \"oz\"]\n".to_owned(),
                "kind = \"lighting\"\nkey = \"lamp\"\ntitle = \"lamp\"\nsource = \"real\"\nscenes = [\"dark\", \"room\"]\n".to_owned(),
            ],
        }
}

fn library() -> LibraryFile {
    LibraryFile {
        path: "target/release/libscale.so".to_owned(),
        sha256: None,
    }
}

#[test]
fn a_new_manifest_says_all_that_the_library_says_and_stays_as_it_is() {
    let text = offer()
        .manifest("", &library(), Some("MIT"))
        .expect("a manifest");
    let manifest = Manifest::parse(&text).expect("it reads");
    assert_eq!(manifest.drivers().count(), 2);
    assert_eq!(manifest.needs.len(), 2);
    // The same replacement as in the tests of a new project.
    for table in &offer().provides {
        let table = table.replace("[[args]]", "[[provides.args]]");
        assert!(text.contains(&table), "{table} in:\n{text}");
    }
    assert_eq!(
        offer().manifest(&text, &library(), None).as_ref(),
        Ok(&text)
    );
    let error = offer()
        .manifest("", &library(), None)
        .expect_err("no licence");
    assert!(error.to_string().contains("--license"), "{error}");
}

#[test]
fn comments_and_order_stay() {
    let text = format!(
        r#"# of our lab
manifest_version = 1
id = "org.example.scale" # the name
name = "the scale"
version = "0.1.0" # counted up
license = "MIT"
abi = {{ major = 1, minor = 0 }}
needs = [
  "usb", # before
  "hid", # now
]

[library] # built
{} = {{ path = "here/libscale.so" }}

# gone with the next build
[[provides]]
kind = "lighting"
key = "torch"
title = "torch"
source = "real"
scenes = ["dark"]

# the one on the bench
[[provides]]
kind = "force"
key = "scale"
title = "the scale on the bench" # ours
source = "real"
axes = ["Fz"]
rate_hz = 10 # measured
noise_N = 0.5
usb = [{{ vendor = 1, product = 2 }}]

# which unit
[[provides.args]]
key = "unit"
type = "choice"
choices = ["g"] # of weight
"#,
        platform()
    );
    let edited = offer().manifest(&text, &library(), None).expect("edited");
    for kept in [
        "# of our lab\n",
        "id = \"org.example.scale\" # the name\n",
        "name = \"the scale\"\n",
        "version = \"0.2.0\" # counted up\n",
        "[library] # built\n",
        "path = \"here/libscale.so\"",
        "# the one on the bench\n[[provides]]\n",
        "title = \"scale\" # ours\n",
        "rate_hz = 10 # measured\n",
        "usb = [{ vendor = 1, product = 2 }]\n",
        "# which unit\n[[provides.args]]\n",
        "choices = [\"g\", \"oz\"] # of weight\n",
        "# now",
    ] {
        assert!(edited.contains(kept), "{kept:?} in:\n{edited}");
    }
    for gone in ["torch", "noise_N", "\"usb\""] {
        assert!(!edited.contains(gone), "{gone} in:\n{edited}");
    }
    assert_eq!(offer().manifest(&edited, &library(), None), Ok(edited));
}

#[test]
fn what_no_manifest_can_say_is_refused() {
    let mut strange = offer();
    strange.needs = vec!["everything".to_owned()];
    let error = strange
        .manifest("", &library(), Some("MIT"))
        .expect_err("no need");
    assert!(error.to_string().contains("`needs`"), "{error}");
    let mut strange = offer();
    strange.provides = vec!["kind = \"force\"\n[[provides]]\n".to_owned()];
    assert!(strange.manifest("", &library(), Some("MIT")).is_err());
    assert!(offer().manifest("a = [", &library(), Some("MIT")).is_err());
}

#[test]
fn a_digest_that_is_there_is_that_of_the_library() {
    let digest = |byte: u8| crate::Sha256Digest([byte; 32]);
    let of = |byte: u8| LibraryFile {
        sha256: Some(digest(byte)),
        ..library()
    };
    let text = offer()
        .manifest("", &of(1), Some("MIT"))
        .expect("a manifest");
    assert!(!text.contains("sha256"), "nobody asked for one");
    let with = text.replace(
        "libscale.so\" }",
        &format!("libscale.so\", sha256 = \"{}\" }}", digest(1)),
    );
    let edited = offer().manifest(&with, &of(2), None).expect("edited");
    assert!(edited.contains(&digest(2).to_string()), "{edited}");
}

#[test]
fn what_is_new_stands_where_the_library_says_it() {
    let text = offer()
        .manifest("", &library(), Some("MIT"))
        .expect("a manifest");
    let mut numbered = offer();
    numbered.provides[0] =
        numbered.provides[0].replace("tare = false", "numbered = true\ntare = false");
    let edited = numbered.manifest(&text, &library(), None).expect("edited");
    assert!(
        edited.contains("rate_hz = 10.0\nnumbered = true\ntare = false\n"),
        "{edited}"
    );
}
