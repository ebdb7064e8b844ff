// Renders an ISF file with npm's interactive-shader-format in a headless Chromium (software WebGL). Time stands still but
// for what is asked: frame n is drawn at n / 60 s.
//
//   node isf_page.js NODE_MODULES CHROMIUM WIDTH HEIGHT FRAME FILE.fs OUT.raw NAME=PICTURE...
//
// Writes RGBA bytes, bottom row first.
const fs = require('fs');
const path = require('path');
const [modules, chromium, width, height, frame, file, out, ...images] = process.argv.slice(2);
const puppeteer = require(path.join(modules, 'puppeteer-core'));

// The package's own sources: its bundle needs what browsers lack.
const root = path.join(modules, 'interactive-shader-format');
const sources = {};
for (const folder of ['src', 'vendor'])
  for (const name of fs.readdirSync(path.join(root, folder)))
    if (name.endsWith('.js')) sources[`${folder}/${name}`] = fs.readFileSync(path.join(root, folder, name), 'utf8');
const vertex = file.replace(/\.fs$/, '.vs');

(async () => {
  const browser = await puppeteer.launch({
    executablePath: chromium,
    headless: 'new',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
  try {
    const page = await browser.newPage();
    page.on('console', (message) => process.stderr.write(`${message.text()}\n`));
    await page.setContent(`<canvas id="c" width="${width}" height="${height}"></canvas>`);
    await page.evaluate((texts) => {
      const loaded = {};
      const load = (name) => {
        if (loaded[name]) return loaded[name].exports;
        const module = (loaded[name] = { exports: {} });
        const find = (wanted) => {
          const parts = name.split('/').slice(0, -1).concat(wanted.split('/'));
          const plain = [];
          for (const part of parts) if (part === '..') plain.pop(); else if (part !== '.') plain.push(part);
          const key = plain.join('/');
          return load(texts[key] ? key : `${key}.js`);
        };
        new Function('module', 'exports', 'require', texts[name])(module, module.exports, find);
        return module.exports;
      };
      window.Renderer = load('src/ISFRenderer.js');
      window.Upgrader = load('src/ISFUpgrader.js');
      window.Texture = load('src/ISFTexture.js');
    }, sources);
    const pictures = images.map((each) => {
      const at = each.indexOf('=');
      return [each.slice(0, at), `data:image/png;base64,${fs.readFileSync(each.slice(at + 1)).toString('base64')}`];
    });
    const texels = await page.evaluate(
      async (fragment, vertexText, wanted, frames, w, h) => {
        const canvas = document.getElementById('c');
        const gl = canvas.getContext('webgl', { preserveDrawingBuffer: true, premultipliedAlpha: false, antialias: false });
        gl.getExtension('OES_texture_float');
        gl.getExtension('OES_texture_float_linear');
        gl.getExtension('WEBGL_color_buffer_float');
        let now = 0;
        Date.now = () => now;
        const renderer = new window.Renderer(gl);
        const old = fragment.includes('PERSISTENT_BUFFERS');
        renderer.loadSource(old ? window.Upgrader.convertFragment(fragment) : fragment, vertexText || undefined);
        if (!renderer.valid) throw new Error(`not valid: ${renderer.error}`);
        const images = [];
        for (const [name, source] of wanted) {
          const image = new Image();
          image.src = source;
          await image.decode();
          // It makes textures for inputs only; imported pictures are the host's.
          const uniform = renderer.uniforms[name];
          if (!uniform.texture) uniform.texture = new window.Texture({}, renderer.contextState);
          images.push([name, image]);
        }
        for (let i = 0; i <= frames; ++i) {
          now = (i * 1000) / 60;
          // As its example does in each frame: else its buffers take the images' texture units.
          for (const [name, image] of images) renderer.setValue(name, image);
          renderer.draw(canvas);
        }
        const pixels = new Uint8Array(w * h * 4);
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return Array.from(pixels);
      },
      fs.readFileSync(file, 'utf8'), fs.existsSync(vertex) ? fs.readFileSync(vertex, 'utf8') : '', pictures,
      Number(frame), Number(width), Number(height));
    fs.writeFileSync(out, Buffer.from(texels));
  } finally {
    await browser.close();
  }
})().catch((error) => {
  process.stderr.write(`${error}\n`);
  process.exit(1);
});
