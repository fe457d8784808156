// SPDX-License-Identifier: Apache-2.0
// Draws a frame: spheres and surface each into a layer, then both into the canvas.

class Renderer {
    /**
     * @param drawBy 'triangles' or 'tiles', or what suits the machine
     * @throws Error where there is no WebGL2
     */
    constructor(canvas, drawBy) {
        this.canvas = canvas;
        const gl = (this.gl = canvas.getContext('webgl2', { antialias: false, alpha: false }));
        if (!gl) throw new Error('this browser has no WebGL2');
        this.byTiles = drawBy ? drawBy === 'tiles' : isSoftware(gl);
        this.sphereProgram = this.byTiles
            ? new Program(gl, kCompositeVertexShader, kTileFragmentShader)
            : new Program(gl, kTriangleVertexShader, kTriangleFragmentShader);
        this.surfaceProgram = new Program(gl, kSurfaceVertexShader, kSurfaceFragmentShader);
        this.compositeProgram = new Program(gl, kCompositeVertexShader, kCompositeFragmentShader);
        this.sphereLayer = new Layer(gl);
        this.surfaceLayer = new Layer(gl);
        this.shapeTable = makeTexture(gl);
        this.colorTable = makeTexture(gl);
        this.tiles = new Tiles();
        this.seenTable = makeTexture(gl);
        this.noAttributes = gl.createVertexArray();
        this.sphereCount = 0;
        this.triangleCount = 0;
    }

    /** The most spheres that a table has room for. */
    get mostSpheres() {
        return kTextureWidth * this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE);
    }

    /** @param shapes four floats a sphere: see Frame */
    setSpheres(shapes) {
        const gl = this.gl;
        this.shapes = shapes;
        this.sphereCount = shapes.length / 4;
        fillTable(gl, this.shapeTable, shapes, this.sphereCount, gl.RGBA32F, gl.FLOAT);
    }

    /** @param colors four bytes a sphere */
    setColors(colors) {
        const gl = this.gl;
        fillTable(gl, this.colorTable, colors, colors.length / 4, gl.RGBA8, gl.UNSIGNED_BYTE);
    }

    /** @param points three floats each, @param quads four numbers of points each */
    setSurface(points, quads) {
        const gl = this.gl;
        this.surfaceArray = gl.createVertexArray();
        gl.bindVertexArray(this.surfaceArray);
        [points, normalsOf(points, quads)].forEach((values, place) => {
            gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
            gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
            gl.enableVertexAttribArray(place);
            gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
        });
        const triangles = trianglesOf(quads);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
        gl.bindVertexArray(null);
        this.triangleCount = triangles.length / 3;
    }

    /**
     * @param view what Camera.view() has
     * @param look opacities, colours, the clip plane, the shape of balls and what is selected
     */
    draw(view, look) {
        const gl = this.gl,
            { width, height } = this.canvas;
        const uniforms = {
            view: view.matrix,
            projection: view.projection,
            near: view.near,
            range: [view.near, view.far],
            pixel: (2 * view.halfHeight) / height,
            clip: seenPlane(view, look.clip),
            reach: look.reach,
            faceCount: look.faces.length,
            ...(look.faces.length > 0 && {
                faces: look.faces.flatMap((face) => turned(view, face)),
            }),
            flatNormal: look.flatNormal ? turned(view, look.flatNormal) : [0, 0, 0],
            selected: look.selected,
            accent: look.accent,
            color: look.surfaceColor,
            opacity: [look.sphereOpacity, look.surfaceOpacity],
            top: look.top,
            bottom: look.bottom,
            shaded: !look.flatNormal,
            size: [width, height],
            ring: look.selectedShape
                ? ringOf(view, look.selectedShape, width, height)
                : [0, 0, -9, 0],
            spheres: 0,
            colors: 1,
            seen: 2,
            sphereColor: 0,
            sphereDepth: 1,
            surfaceColor: 2,
            surfaceDepth: 3,
        };
        this.sphereLayer.begin(width, height);
        if (look.sphereOpacity > 0 && this.byTiles) this.#drawTiles(view, look, uniforms);
        else if (look.sphereOpacity > 0) this.#drawTriangles(uniforms);
        this.surfaceLayer.begin(width, height);
        if (look.surfaceOpacity > 0 && this.triangleCount > 0) this.#drawSurface(uniforms);
        this.#compose(uniforms);
    }

    #drawTriangles(uniforms) {
        this.sphereProgram.use(uniforms);
        this.#bind([this.shapeTable, this.colorTable]);
        this.gl.bindVertexArray(this.noAttributes);
        this.gl.drawArrays(this.gl.TRIANGLES, 0, 3 * this.sphereCount);
    }

    #drawTiles(view, look, uniforms) {
        const { gl, tiles } = this;
        tiles.find(this.shapes, look, view, ...uniforms.size);
        fillNumbers(gl, this.seenTable, tiles.seen, ...uniforms.size);
        this.sphereProgram.use({ ...uniforms, isKnown: true });
        this.#bind([this.shapeTable, this.colorTable, this.seenTable]);
        gl.bindVertexArray(this.noAttributes);
        gl.depthFunc(gl.ALWAYS);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.depthFunc(gl.LESS);
    }

    #drawSurface(uniforms) {
        const gl = this.gl;
        this.surfaceProgram.use(uniforms);
        gl.bindVertexArray(this.surfaceArray);
        gl.drawElements(gl.TRIANGLES, 3 * this.triangleCount, gl.UNSIGNED_INT, 0);
    }

    #compose(uniforms) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, ...uniforms.size);
        gl.disable(gl.DEPTH_TEST);
        this.compositeProgram.use(uniforms);
        this.#bind([
            this.sphereLayer.color,
            this.sphereLayer.depth,
            this.surfaceLayer.color,
            this.surfaceLayer.depth,
        ]);
        gl.bindVertexArray(this.noAttributes);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }

    #bind(textures) {
        textures.forEach((texture, place) => {
            this.gl.activeTexture(this.gl.TEXTURE0 + place);
            this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
        });
        this.gl.activeTexture(this.gl.TEXTURE0);
    }

    /** Calls back when the frame is there, without holding up the page. */
    whenDone(callBack) {
        const gl = this.gl;
        const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        const look = () => {
            const isDone =
                gl.isContextLost() || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
            if (!isDone) {
                setTimeout(look, 4);
                return;
            }
            gl.deleteSync(fence);
            callBack();
        };
        setTimeout(look, 0);
    }
}

/** Whether there is no graphics card behind it; then what is drawn twice costs twice. */
function isSoftware(gl) {
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    const name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
    return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/** A direction as it is seen from the eye. */
const turned = (view, a) => [dot(view.x, a), dot(view.y, a), dot(view.z, a)];

/** A plane that keeps dot(normal, p) + offset >= 0, the same seen from the eye; null keeps all. */
function seenPlane(view, plane) {
    if (!plane) return [0, 0, 0, 1];
    return [...turned(view, plane.normal), plane.offset + dot(plane.normal, view.eye)];
}

/** Place, radius and width of a circle around a shape, in pixels. */
function ringOf(view, [x, y, z, radius], width, height) {
    const kWidth = Math.max(2, height / 300);
    const [right, up, back] = turned(view, minus([x, y, z], view.eye));
    const distance = -back;
    if (distance <= 0) return [0, 0, -9, 0];
    const half = height / 2 / view.halfHeight; // pixels to one at distance 1
    const sine = Math.min(0.99, radius / Math.hypot(right, up, back));
    const size = Math.max((half * radius) / distance / Math.sqrt(1 - sine * sine), 4);
    return [
        width / 2 + (half * right) / distance,
        height / 2 + (half * up) / distance,
        size + kWidth,
        kWidth,
    ];
}
