//! A headless Chromium and the pages that it shows.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use headless_chrome::browser::default_executable;
use headless_chrome::browser::tab::point::Point;
use headless_chrome::protocol::cdp::{Emulation, Input, Network, Page, types::Event};
use headless_chrome::{Browser, LaunchOptions, Tab};
use serde_json::Value;
use skipping::Skipped;
use tempfile::TempDir;

/// How long a page may take on a busy machine before it counts as failed.
const PATIENCE: Duration = Duration::from_mins(2);

pub(crate) struct Chrome {
    browser: Browser,
}

impl Chrome {
    /// The browser that there is.
    pub(crate) fn find() -> Result<Self, Skipped> {
        let Ok(path) = default_executable() else {
            return Err(Skipped::because("there is no Chromium on the path, nor in the variable CHROME"));
        };
        let options = LaunchOptions::default_builder()
            .path(Some(path))
            // Containers lack what the sandbox needs, and the pages are our own.
            .sandbox(false)
            .idle_browser_timeout(PATIENCE)
            .build()
            .expect("options");
        Ok(Self { browser: Browser::new(options).expect("Chromium starts") })
    }

    /// Opens a page and waits until its charts are drawn.
    pub(crate) fn open(&self, name: &str, html: &str, [width, height]: [u32; 2], dark: bool) -> Shown {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join(format!("{name}.html"));
        fs::write(&file, html).expect("writable");
        let tab = self.browser.new_tab().expect("a tab");
        tab.set_default_timeout(PATIENCE);
        let heard = Arc::new(Mutex::new(Vec::new()));
        let ears = Arc::clone(&heard);
        tab.add_event_listener(Arc::new(move |event: &Event| {
            if let Some(complaint) = complaint(event) {
                ears.lock().expect("alone").push(complaint);
            }
        }))
        .expect("a listener");
        tab.enable_runtime().expect("enabled");
        tab.enable_log().expect("enabled");
        tab.call_method(Network::Enable {
            max_total_buffer_size: None,
            max_resource_buffer_size: None,
            max_post_data_size: None,
            report_direct_socket_traffic: None,
            enable_durable_messages: None,
        })
        .expect("enabled");
        tab.call_method(Emulation::SetDeviceMetricsOverride {
            width,
            height,
            device_scale_factor: 1.0,
            mobile: false,
            scale: None,
            screen_width: None,
            screen_height: None,
            position_x: None,
            position_y: None,
            dont_set_visible_size: None,
            screen_orientation: None,
            viewport: None,
            display_feature: None,
            device_posture: None,
        })
        .expect("a size");
        let scheme = Emulation::MediaFeature {
            name: "prefers-color-scheme".to_owned(),
            value: if dark { "dark" } else { "light" }.to_owned(),
        };
        tab.call_method(Emulation::SetEmulatedMedia { media: None, features: Some(vec![scheme]) }).expect("a theme");
        tab.bring_to_front().expect("in front");
        tab.navigate_to(&format!("file://{}", file.display())).expect("opens");
        tab.wait_until_navigated().expect("opens");
        let shown = Shown { tab, heard, width, _folder: folder };
        shown.wait_for("document.readyState === 'complete' && plots.every(p => p.drawn || !p.checkVisibility())");
        shown
    }
}

/// What a page does that it should not.
fn complaint(event: &Event) -> Option<String> {
    match event {
        Event::RuntimeExceptionThrown(e) => Some(format!("exception: {:?}", e.params.exception_details)),
        Event::RuntimeConsoleAPICalled(e) => Some(format!("console: {:?}", e.params.args)),
        Event::LogEntryAdded(e) => Some(format!("log: {}", e.params.entry.text)),
        Event::NetworkRequestWillBeSent(e) => {
            let url = &e.params.request.url;
            let own = ["file:", "data:", "blob:"].iter().any(|scheme| url.starts_with(scheme));
            (!own).then(|| format!("request: {url}"))
        }
        _ => None,
    }
}

/// A page that is shown.
pub(crate) struct Shown {
    tab: Arc<Tab>,
    heard: Arc<Mutex<Vec<String>>>,
    width: u32,
    _folder: TempDir,
}

impl Shown {
    /// The value of an expression.
    pub(crate) fn json(&self, expression: &str) -> Value {
        let text = format!("JSON.stringify({expression}) ?? 'null'");
        let value = self.tab.evaluate(&text, false).unwrap_or_else(|e| panic!("{expression}: {e}")).value;
        let text = value.as_ref().and_then(Value::as_str).unwrap_or_else(|| panic!("{expression}: no value"));
        serde_json::from_str(text).expect("JSON")
    }

    /// Waits until an expression is true.
    pub(crate) fn wait_for(&self, expression: &str) {
        let begin = Instant::now();
        // Before the scripts have run, their names are unknown.
        let guarded = format!("(() => {{ try {{ return {expression}; }} catch {{ return false; }} }})()");
        while self.json(&guarded) != Value::Bool(true) {
            assert!(begin.elapsed() < PATIENCE, "never true: {expression}; {:?}", self.complaints());
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// What the page did that it should not.
    pub(crate) fn complaints(&self) -> Vec<String> {
        self.heard.lock().expect("alone").clone()
    }

    /// The middle of an element in the window.
    pub(crate) fn middle_of(&self, element: &str) -> [f64; 2] {
        let at = self.json(&format!(
            "(e => {{ const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})({element})"
        ));
        [0, 1].map(|i| at[i].as_f64().expect("a number"))
    }

    /// Moves the mouse.
    pub(crate) fn point_at(&self, x: f64, y: f64) {
        self.tab.move_mouse_to_point(Point { x, y }).expect("moves");
        std::thread::sleep(Duration::from_millis(120));
    }

    /// Drags from a point to another one.
    pub(crate) fn drag(&self, [x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) {
        self.point_at(x, y);
        self.mouse(Input::DispatchMouseEventTypeOption::MousePressed, x, y);
        for part in [0.3, 0.6, 1.0] {
            let (x, y) = (x + part * (to_x - x), y + part * (to_y - y));
            self.mouse(Input::DispatchMouseEventTypeOption::MouseMoved, x, y);
            std::thread::sleep(Duration::from_millis(60));
        }
        self.mouse(Input::DispatchMouseEventTypeOption::MouseReleased, to_x, to_y);
    }

    fn mouse(&self, kind: Input::DispatchMouseEventTypeOption, x: f64, y: f64) {
        self.tab
            .call_method(Input::DispatchMouseEvent {
                Type: kind,
                x,
                y,
                button: Some(Input::MouseButton::Left),
                buttons: Some(1),
                click_count: Some(1),
                modifiers: None,
                timestamp: None,
                force: None,
                tangential_pressure: None,
                tilt_x: None,
                tilt_y: None,
                twist: None,
                delta_x: None,
                delta_y: None,
                pointer_Type: None,
            })
            .expect("the mouse works");
    }

    /// Presses a key.
    pub(crate) fn press(&self, key: &str) {
        self.tab.press_key(key).unwrap_or_else(|e| panic!("key {key}: {e}"));
    }

    /// Keeps a picture of the whole page, to be looked at, where the variable `PICTURES` is set: drawing it takes longer than the tests.
    pub(crate) fn screenshot(&self, name: &str) {
        if std::env::var_os("PICTURES").is_none() {
            return;
        }
        let height = self.json("document.documentElement.scrollHeight").as_f64().expect("a height");
        let clip = Page::Viewport { x: 0.0, y: 0.0, width: f64::from(self.width), height, scale: 1.0 };
        let shot = Page::CaptureScreenshot {
            format: Some(Page::CaptureScreenshotFormatOption::Png),
            clip: Some(clip),
            quality: None,
            from_surface: Some(true),
            capture_beyond_viewport: Some(true),
            optimize_for_speed: Some(true),
        };
        let data = self.tab.call_method(shot).expect("a picture").data;
        keep(&format!("{name}.png"), &base64(&data));
    }

    /// Prints to a PDF, to be looked at.
    pub(crate) fn print(&self, name: &str) {
        let pdf = self.tab.print_to_pdf(None).expect("prints");
        assert!(pdf.starts_with(b"%PDF"));
        keep(&format!("{name}.pdf"), &pdf);
    }
}

fn base64(text: &str) -> Vec<u8> {
    use base64::prelude::{BASE64_STANDARD, Engine};
    BASE64_STANDARD.decode(text).expect("base64")
}

/// Writes a file where build products live.
fn keep(name: &str, bytes: &[u8]) {
    let folder: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser");
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join(name), bytes).expect("writable");
}
