// Browsers do not start workers for pages opened as files. A frame that runs the same script replaces the worker and
// exchanges the same messages with the page. Not loaded on a web server.
window.Worker = class extends EventTarget {
    constructor(url) {
        super();
        const frame = document.createElement("iframe");
        frame.hidden = true;
        this.inside = new Promise((resolve) => frame.addEventListener("load", () => {
            const inside = frame.contentWindow, page = frame.contentDocument;
            const load = (source) => new Promise((done) => {
                const script = page.createElement("script");
                script.src = source;
                script.onload = done;
                page.body.append(script);
            });
            inside.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", {data}));
            inside.importScripts = (...urls) => urls.reduce((before, source) => before.then(() => load(source)), Promise.resolve());
            load(new URL(url, location.href).href).then(() => resolve(inside));
        }, {once: true}));
        document.documentElement.append(frame);
    }
    postMessage(data) {
        this.inside.then((inside) => inside.dispatchEvent(new inside.MessageEvent("message", {data})));
    }
    terminate() {}
};
