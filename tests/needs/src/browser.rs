//! Browser controlled over two pipes (Chrome DevTools Protocol, `--remote-debugging-pipe`).

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

/// Names of browser programs that are searched for on the path.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// A browser with one open page.
pub struct Browser {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    next: u64,
    session: Option<String>,
    /// Events that the browser has sent.
    events: Vec<Value>,
}

impl Browser {
    /// Starts a browser that keeps its files in `folder`. `None` if no browser is installed.
    ///
    /// # Panics
    /// If an installed browser does not start. Every call panics if the browser does not answer.
    pub fn start(folder: &Path) -> Option<Browser> {
        let paths = std::env::var_os("PATH")?;
        let found = std::env::split_paths(&paths).find_map(|path| {
            let mut names = NAMES.iter().map(|name| path.join(name));
            names.find(|program| program.is_file())
        })?;
        // The protocol uses the descriptors 3 and 4, which a shell duplicates from 0 and 1.
        let script = "exec \"$0\" \"$@\" 3<&0 4>&1 >/dev/null 2>&1";
        let mut child = Command::new("sh")
            .args(["-c", script])
            .arg(found)
            .args([
                "--headless=new",
                "--no-sandbox",
                "--disable-gpu",
                "--remote-debugging-pipe",
            ])
            .arg("--window-size=1100,1000")
            .arg(format!(
                "--user-data-dir={}",
                folder.join("profile").display()
            ))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a shell");
        let to = child.stdin.take().expect("piped");
        let from = BufReader::new(child.stdout.take().expect("piped"));
        let mut browser = Browser {
            child,
            to,
            from,
            next: 0,
            session: None,
            events: Vec::new(),
        };
        let target = browser.call("Target.createTarget", json!({"url": "about:blank"}));
        let attach = json!({"targetId": target["targetId"], "flatten": true});
        let attached = browser.call("Target.attachToTarget", attach);
        browser.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Network", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser.events.clear();
        Some(browser)
    }

    /// Opens `address` and waits until it is loaded.
    ///
    /// # Panics
    /// If the browser ends.
    pub fn open(&mut self, address: &str) {
        let before = self.events.len();
        self.call("Page.navigate", json!({"url": address}));
        while !self.events[before..]
            .iter()
            .any(|event| event["method"] == "Page.loadEventFired")
        {
            let message = self.read();
            self.events.push(message);
        }
    }

    /// Runs a script and returns its value, or the value of its promise.
    ///
    /// # Panics
    /// If the script throws.
    pub fn evaluate(&mut self, script: &str) -> Value {
        let answer = self.call(
            "Runtime.evaluate",
            json!({"expression": script, "returnByValue": true, "awaitPromise": true}),
        );
        assert!(answer["exceptionDetails"].is_null(), "{script}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Sends a call and returns the answer. Stores events that arrive before the answer.
    ///
    /// # Panics
    /// If the browser rejects the call.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.next += 1;
        let id = self.next;
        let mut message = json!({"id": id, "method": method, "params": parameters});
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.to.write_all(&bytes).expect("the browser listens");
        loop {
            let message = self.read();
            if message["id"] == id {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
            self.events.push(message);
        }
    }

    /// Writes the visible page to `path`, as PNG.
    ///
    /// # Panics
    /// If it cannot be written.
    pub fn screenshot(&mut self, path: &Path) {
        let taken = self.call("Page.captureScreenshot", json!({"format": "png"}));
        let text = taken["data"].as_str().expect("a picture");
        std::fs::write(path, from_base64(text)).expect("written");
    }

    fn read(&mut self) -> Value {
        let mut bytes = Vec::new();
        self.from
            .read_until(0, &mut bytes)
            .expect("the browser answers");
        bytes.pop();
        serde_json::from_slice(&bytes).expect("JSON")
    }

    /// Fails if the console has a message, a dialog was shown, or an address was requested for which `is_own` returns false.
    ///
    /// # Panics
    /// If any of these happened.
    pub fn assert_quiet(&mut self, is_own: impl Fn(&str) -> bool) {
        // Events on their way arrive before this answer.
        self.evaluate("1");
        for event in &self.events {
            let method = event["method"].as_str().unwrap_or_default();
            let loud = [
                "Runtime.consoleAPICalled",
                "Runtime.exceptionThrown",
                "Log.entryAdded",
                "Page.javascriptDialogOpening",
            ];
            assert!(!loud.contains(&method), "{event}");
            if method == "Network.requestWillBeSent" {
                let url = event["params"]["request"]["url"]
                    .as_str()
                    .unwrap_or_default();
                assert!(is_own(url), "{url}");
            }
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // The browser may have ended by itself.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

/// Decodes base64, the encoding of files from the browser.
///
/// # Panics
/// If the text is not base64.
pub fn from_base64(text: &str) -> Vec<u8> {
    BASE64_STANDARD.decode(text).expect("base64")
}
