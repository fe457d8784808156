// SPDX-License-Identifier: Apache-2.0
// Small helpers around WebGL2.

/** A program with the places of its uniforms. */
class Program {
    constructor(gl, vertexSource, fragmentSource) {
        this.gl = gl;
        this.handle = gl.createProgram();
        for (const [type, source] of [
            [gl.VERTEX_SHADER, vertexSource],
            [gl.FRAGMENT_SHADER, fragmentSource],
        ]) {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
                throw new Error(gl.getShaderInfoLog(shader));
            }
            gl.attachShader(this.handle, shader);
        }
        gl.linkProgram(this.handle);
        if (!gl.getProgramParameter(this.handle, gl.LINK_STATUS)) {
            throw new Error(gl.getProgramInfoLog(this.handle));
        }
        this.uniforms = new Map();
        const count = gl.getProgramParameter(this.handle, gl.ACTIVE_UNIFORMS);
        for (let i = 0; i < count; ++i) {
            const { name, type } = gl.getActiveUniform(this.handle, i);
            const place = gl.getUniformLocation(this.handle, name);
            this.uniforms.set(name.replace('[0]', ''), { place, type });
        }
    }

    /** Uses the program with these values by name; those that it does not have are left out. */
    use(values) {
        const gl = this.gl;
        gl.useProgram(this.handle);
        for (const [name, value] of Object.entries(values)) {
            const uniform = this.uniforms.get(name);
            if (!uniform) continue;
            const { place, type } = uniform;
            if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(place, false, value);
            else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, value);
            else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
            else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, value);
            else if (type === gl.FLOAT) gl.uniform1f(place, value);
            else gl.uniform1i(place, value);
        }
    }
}

/** A texture whose texels are read one by one. */
function makeTexture(gl) {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
        gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    }
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
        gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    }
    return texture;
}

/** Fills rows of kTextureWidth texels with four values for each of `count` things. */
function fillTable(gl, texture, values, count, internalFormat, type) {
    const rows = Math.max(1, Math.ceil(count / kTextureWidth));
    const padded = new values.constructor(4 * rows * kTextureWidth);
    padded.set(values);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, internalFormat, kTextureWidth, rows, 0, gl.RGBA, type, padded);
}

/** Fills rows of `width` texels with a number each. */
function fillNumbers(gl, texture, values, width, height) {
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(
        gl.TEXTURE_2D,
        0,
        gl.R32UI,
        width,
        height,
        0,
        gl.RED_INTEGER,
        gl.UNSIGNED_INT,
        values,
    );
}

/** What is drawn aside, with a colour and a depth for each pixel. */
class Layer {
    constructor(gl) {
        this.gl = gl;
        this.color = makeTexture(gl);
        this.depth = makeTexture(gl);
        this.frame = gl.createFramebuffer();
    }

    /** Ready to be drawn into, and empty. */
    begin(width, height) {
        const gl = this.gl;
        if (width !== this.width || height !== this.height) this.#resize(width, height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
        gl.viewport(0, 0, width, height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.DEPTH_TEST);
    }

    #resize(width, height) {
        const gl = this.gl;
        this.width = width;
        this.height = height;
        gl.bindTexture(gl.TEXTURE_2D, this.color);
        gl.texImage2D(
            gl.TEXTURE_2D,
            0,
            gl.RGBA8,
            width,
            height,
            0,
            gl.RGBA,
            gl.UNSIGNED_BYTE,
            null,
        );
        gl.bindTexture(gl.TEXTURE_2D, this.depth);
        gl.texImage2D(
            gl.TEXTURE_2D,
            0,
            gl.DEPTH_COMPONENT24,
            width,
            height,
            0,
            gl.DEPTH_COMPONENT,
            gl.UNSIGNED_INT,
            null,
        );
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
        for (const [attachment, texture] of [
            [gl.COLOR_ATTACHMENT0, this.color],
            [gl.DEPTH_ATTACHMENT, this.depth],
        ]) {
            gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, texture, 0);
        }
    }
}
